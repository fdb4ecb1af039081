#include <slamot/perception/LaserClusters.h>

#include <cmath>

namespace slamot::perception
{
namespace
{
double distance(const Point2D& a, const Point2D& b)
{
  return std::hypot(a.x - b.x, a.y - b.y);
}

/// The returns of a scan, beam by beam.
std::vector<ScanPoint> pointsOf(const core::LaserScan& scan, double maxRange)
{
  std::vector<ScanPoint> out;
  const Pose2D& sensor = scan.pose_robot_sensor;
  for (std::size_t i = 0; i < scan.ranges.size(); ++i)
  {
    const double r = scan.ranges[i];
    if (!(r > 0 && r < scan.rangeMax && r <= maxRange)) continue;
    const double a = scan.angleMin + static_cast<double>(i) * scan.angleStep;
    ScanPoint& p = out.emplace_back();
    p.at = math::transform(sensor, {r * std::cos(a), r * std::sin(a)});
    p.range = r;
    p.angle = math::wrapToPi(sensor.phi + a);
    p.beam = i;
  }
  return out;
}

class Parting
{
 public:
  Parting(const core::LaserScan& scan, const LaserOptions& options) : scan_(scan), options_(options)
  {
    isClosed_ = std::abs(scan.angleStep) * static_cast<double>(scan.ranges.size()) >
                math::kTwoPi - 0.5 * std::abs(scan.angleStep);
  }

  [[nodiscard]] bool isClosed() const { return isClosed_; }

  /// Whether neighbouring returns may be of one surface.
  [[nodiscard]] bool belong(const ScanPoint& a, const ScanPoint& b) const
  {
    constexpr std::size_t kMissing = 2;  // beams that may be lost on it
    const std::size_t n = scan_.ranges.size();
    const std::size_t apart = (b.beam + n - a.beam) % n;
    if (apart > kMissing + 1) return false;
    const double turn = std::abs(scan_.angleStep) * static_cast<double>(apart);
    const double nearer = std::min(a.range, b.range);
    const double surface = turn < options_.flattest
                               ? nearer * std::sin(turn) / std::sin(options_.flattest - turn)
                               : nearer;
    return distance(a.at, b.at) <= options_.jump + surface;
  }

  /// Whether nothing nearer lies beside a cluster's end: `step` beams on, 1 or -1.
  [[nodiscard]] bool isFree(const ScanPoint& end, int step) const
  {
    const auto n = static_cast<std::ptrdiff_t>(scan_.ranges.size());
    std::ptrdiff_t i = static_cast<std::ptrdiff_t>(end.beam) + step;
    if (isClosed_) i = (i + n) % n;
    if (i < 0 || i >= n) return false;
    const double r = scan_.ranges[static_cast<std::size_t>(i)];
    return !(r > 0) || r > end.range;
  }

 private:
  const core::LaserScan& scan_;
  const LaserOptions& options_;
  bool isClosed_ = false;
};
}  // namespace

double Cluster::width() const
{
  return distance(points.front().at, points.back().at);
}

LaserOptions LaserOptions::from(core::Params& p, const LaserOptions& otherwise)
{
  LaserOptions out = otherwise;
  out.rangeStd = p.positive("range_std_m", out.rangeStd);
  out.maxRange = p.positive("max_range_m", out.maxRange);
  out.jump = p.positive("jump_m", out.jump);
  out.flattest = p.inRange("flattest_deg", 1, 60, out.flattest);
  return out;
}

std::vector<Cluster> clustersOf(const core::LaserScan& scan, const LaserOptions& options)
{
  std::vector<Cluster> out;
  if (!(std::abs(scan.angleStep) > 0)) return out;
  const Parting parting(scan, options);
  std::vector<ScanPoint> points = pointsOf(scan, options.maxRange);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    if (i == 0 || !parting.belong(points[i - 1], points[i])) out.emplace_back();
    out.back().points.push_back(points[i]);
  }
  if (parting.isClosed() && out.size() > 1 && parting.belong(points.back(), points.front()))
  {
    auto& last = out.back().points;
    last.insert(last.end(), out.front().points.begin(), out.front().points.end());
    out.front() = std::move(out.back());
    out.pop_back();
  }
  const int leftwards = scan.angleStep > 0 ? 1 : -1;
  for (Cluster& c : out)
  {
    if (leftwards < 0) std::reverse(c.points.begin(), c.points.end());
    c.freeRight = parting.isFree(c.points.front(), -leftwards);
    c.freeLeft = parting.isFree(c.points.back(), leftwards);
  }
  return out;
}
}  // namespace slamot::perception
