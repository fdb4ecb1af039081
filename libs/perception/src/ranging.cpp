#include <slamot/perception/ranging.h>

#include <cmath>

namespace slamot::perception
{
namespace
{

/// A fitted centre in the robot's frame at the image's time.
Gaussian<Point2D> moved(const Gaussian<Point2D>& center, const Pose2D& robot_image_scan)
{
  const Matrix2 turn = math::poseRotation(robot_image_scan.phi).topLeftCorner<2, 2>();
  return {math::transform(robot_image_scan, center.mean), turn * center.cov * turn.transpose()};
}

/// Takes in the camera's bearing, a Kalman update along the one row that it tells.
/// \returns nothing if it is out of the gate, or the thing at the camera itself.
std::optional<RangedObject> seenAs(const Gaussian<Point2D>& center, const Gaze& gaze, double gate)
{
  const double dx = center.mean.x - gaze.from.x, dy = center.mean.y - gaze.from.y;
  const double range = std::hypot(dx, dy);
  if (range < 1e-3) return std::nullopt;
  const Vector2 h(-dy / (range * range), dx / (range * range));
  const double innovation = math::wrapToPi(gaze.bearing - std::atan2(dy, dx));
  const double s = h.dot(center.cov * h) + gaze.bearingStd * gaze.bearingStd;
  if (innovation * innovation > gate * gate * s) return std::nullopt;
  const Vector2 gain = center.cov * h / s;
  RangedObject out;
  out.center.mean = {center.mean.x + gain[0] * innovation, center.mean.y + gain[1] * innovation};
  out.center.cov = center.cov - gain * s * gain.transpose();
  const double x = out.center.mean.x - gaze.from.x, y = out.center.mean.y - gaze.from.y;
  out.range = std::hypot(x, y);
  out.bearing = std::atan2(y, x);
  const Vector2 along(x / out.range, y / out.range), across(-along[1], along[0]);
  out.rangeStd = std::sqrt(along.dot(out.center.cov * along));
  out.bearingStd = std::sqrt(across.dot(out.center.cov * across)) / out.range;
  return out;
}
}  // namespace

RangingOptions RangingOptions::from(core::Params& p)
{
  RangingOptions out;
  out.gate = p.positive("gate_sigmas", out.gate);
  out.leastPoints = p.integer("min_points", 2, 1000, out.leastPoints);
  out.mostMisfit = p.positive("max_misfit", out.mostMisfit);
  const std::string how = p.choice("ambiguous", {"refuse", "nearest", "keep"}, "refuse");
  out.ambiguous = how == "keep"      ? Ambiguous::kKeep
                  : how == "nearest" ? Ambiguous::kNearest
                                     : Ambiguous::kRefuse;
  return out;
}

std::vector<RangedObject> objectsSeen(const Gaze& gaze, const Pose2D& robot_image_scan,
                                      const core::LaserScan& scan,
                                      const std::vector<Cluster>& clusters,
                                      const LaserOptions& laser, const RangingOptions& options)
{
  const Point2D from{scan.pose_robot_sensor.x, scan.pose_robot_sensor.y};
  const double widest = 2 * (options.object.radius + 3 * options.object.radiusStd);
  std::vector<RangedObject> out;
  for (std::size_t i = 0; i < clusters.size(); ++i)
  {
    const Cluster& cluster = clusters[i];
    if (static_cast<int>(cluster.points.size()) < options.leastPoints ||
        cluster.width() > widest + 6 * laser.rangeStd)
      continue;
    const auto fit =
        fitCircle(cluster.points, from, scan.angleStep, laser.rangeStd, options.object);
    if (!fit || fit->points < options.leastPoints || fit->misfit > options.mostMisfit) continue;
    if (auto object = seenAs(moved(fit->center, robot_image_scan), gaze, options.gate))
    {
      object->cluster = i;
      out.push_back(*object);
    }
  }
  std::sort(out.begin(), out.end(),
            [](const RangedObject& a, const RangedObject& b) { return a.range < b.range; });
  return out;
}
}  // namespace slamot::perception
