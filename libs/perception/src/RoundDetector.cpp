#include <slamot/perception/RoundDetector.h>

#include <cmath>

namespace slamot::perception
{
RoundOptions RoundOptions::posts()
{
  return {};
}

RoundOptions RoundOptions::trees()
{
  RoundOptions out;
  out.roundness = {0.25, 0.2};
  out.least = 0.02;
  out.most = 0.8;
  out.leastPoints = 2;
  out.maxRange = 50;
  return out;
}

RoundOptions RoundOptions::from(core::Params& p, const RoundOptions& defaults)
{
  RoundOptions out = defaults;
  out.roundness.radius = p.positive("radius_m", defaults.roundness.radius);
  out.roundness.radiusStd = p.positive("radius_std_m", defaults.roundness.radiusStd);
  out.least = p.nonNegative("min_radius_m", defaults.least);
  out.most = p.positive("max_radius_m", defaults.most);
  if (out.most <= out.least)
    p.fail("max_radius_m", "is not above min_radius_m", "choose a larger one");
  out.leastPoints = p.integer("min_points", 2, 1000, defaults.leastPoints);
  out.maxRange = p.positive("max_range_m", defaults.maxRange);
  out.mostMisfit = p.positive("max_misfit", defaults.mostMisfit);
  return out;
}

bool RoundDetector::mayBe(const Cluster& cluster) const
{
  const double range = cluster.points[cluster.points.size() / 2].range;
  return cluster.freeLeft && cluster.freeRight &&
         static_cast<int>(cluster.points.size()) >= options_.leastPoints &&
         range <= options_.maxRange && cluster.width() <= 2 * options_.most + 6 * laser_.rangeStd;
}

std::vector<DetectedLandmark> RoundDetector::detect(const core::LaserScan& scan,
                                                    const std::vector<Cluster>& clusters) const
{
  const Point2D laser{scan.pose_robot_sensor.x, scan.pose_robot_sensor.y};
  std::vector<DetectedLandmark> out;
  for (const Cluster& cluster : clusters)
  {
    if (!mayBe(cluster)) continue;
    const auto fit =
        fitCircle(cluster.points, laser, scan.angleStep, laser_.rangeStd, options_.roundness);
    if (!fit || fit->points < options_.leastPoints || fit->misfit > options_.mostMisfit ||
        fit->radius < options_.least || fit->radius > options_.most)
      continue;
    out.push_back({fit->center, fit->radius});
  }
  return out;
}
}  // namespace slamot::perception
