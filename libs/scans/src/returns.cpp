#include <slamot/scans/returns.h>

#include <cmath>
#include <unordered_set>

namespace slamot::scans
{
std::vector<Return> returnsOf(const std::vector<std::shared_ptr<const core::LaserScan>>& lasers,
                              double farthest)
{
  std::vector<Return> out;
  std::size_t beam = 0;
  for (const auto& laser : lasers)
    for (std::size_t i = 0; i < laser->ranges.size(); ++i, ++beam)
    {
      const double range = laser->ranges[i];
      if (!(range > 0 && range < laser->rangeMax && range < farthest)) continue;
      const double angle = laser->angleMin + static_cast<double>(i) * laser->angleStep;
      const Point2D p = math::transform(laser->pose_robot_sensor,
                                        {range * std::cos(angle), range * std::sin(angle)});
      // A sensor's pose from a damaged log may be anything.
      if (std::hypot(p.x, p.y) < 2 * farthest) out.push_back({p, beam});
    }
  return out;
}

std::vector<Point2D> thinned(const std::vector<Point2D>& points, double cell)
{
  std::vector<Point2D> out;
  std::unordered_set<std::uint64_t> taken;
  for (const Point2D& p : points)
  {
    const auto x = static_cast<std::int32_t>(std::floor(p.x / cell));
    const auto y = static_cast<std::int32_t>(std::floor(p.y / cell));
    const std::uint64_t key =
        std::uint64_t{static_cast<std::uint32_t>(x)} << 32 | static_cast<std::uint32_t>(y);
    if (taken.insert(key).second) out.push_back(p);
  }
  return out;
}
}  // namespace slamot::scans
