#include "Thing.h"

#include <algorithm>
#include <cmath>

namespace slamot::moving
{
namespace
{
/// Where a thing ends beside a return, `step` beams on: between these beams, if the next one sees
/// something farther away.  If it sees nothing, the thing may go on: dark parts and flat angles
/// give no return.
End endAt(const perception::ScanPoint& end, int step, const Look& look)
{
  constexpr double kDoubtful = 3;  // beams
  const auto n = static_cast<std::ptrdiff_t>(look.scan->ranges.size());
  const std::ptrdiff_t next = (static_cast<std::ptrdiff_t>(end.beam) + step + n) % n;
  const double r = look.scan->ranges[static_cast<std::size_t>(next)];
  const bool isSure = r > end.range && r < look.scan->rangeMax;
  return {math::wrapToPi(look.towards(look.at(end)) + 0.5 * step * look.scan->angleStep),
          (isSure ? 0.5 : kDoubtful) * look.beamStep};
}
}  // namespace

Look::Look(double time_, const Pose2D& robot_, const core::LaserScan& scan_)
    : time(time_),
      robot(robot_),
      laser(math::compose(robot_, scan_.pose_robot_sensor)),
      beamStep(std::abs(scan_.angleStep)),
      scan(&scan_)
{
}

Point2D Look::at(const perception::ScanPoint& p) const
{
  return math::transform(robot, p.at);
}

double Look::towards(const Point2D& p) const
{
  return std::atan2(p.y - laser.y, p.x - laser.x);
}

double Look::rangeOf(const Point2D& p) const
{
  return std::hypot(p.x - laser.x, p.y - laser.y);
}

bool Look::goesThrough(const Point2D& p, double depth) const
{
  constexpr double kCore = 0.1;  // [m] around its middle: beams near its ends may miss it
  if (!(beamStep > 0)) return false;
  const double range = rangeOf(p);
  const double turn = math::wrapToPi(towards(p) - laser.phi - scan->angleMin);
  const double ahead = std::copysign(1.0, scan->angleStep) * turn;
  const double middle = (ahead < 0 ? ahead + math::kTwoPi : ahead) / beamStep;
  const auto most = static_cast<double>(scan->ranges.size());
  const int reach = static_cast<int>(std::min(std::atan2(kCore, range) / beamStep, most));
  int through = 0, stopped = 0;
  for (int k = -reach; k <= reach; ++k)
  {
    const double i = std::round(middle + k);
    if (!(i >= 0 && i < static_cast<double>(scan->ranges.size()))) continue;
    const double r = scan->ranges[static_cast<std::size_t>(i)];
    if (!(r > 0) || r >= scan->rangeMax) continue;
    ++(r > range + depth ? through : stopped);
  }
  return through > stopped;
}

Thing thingOf(const perception::Cluster& cluster, std::size_t from, std::size_t to,
              const Look& look, const FreeSpace& space)
{
  Thing out;
  double x = 0, y = 0;
  for (std::size_t i = from; i < to; ++i)
  {
    const Point2D at = look.at(cluster.points[i]);
    out.points.push_back(at);
    out.beams.push_back(cluster.points[i].beam);
    x += at.x, y += at.y;
  }
  const auto n = static_cast<double>(to - from);
  out.centre = {x / n, y / n};
  out.isWhole = cluster.freeRight && cluster.freeLeft;
  out.freePart = freePartOf(out.points, look, space);
  const int leftwards = look.scan->angleStep > 0 ? 1 : -1;
  if (from == 0 && cluster.freeRight) out.right = endAt(cluster.points.front(), -leftwards, look);
  if (to == cluster.points.size() && cluster.freeLeft)
    out.left = endAt(cluster.points.back(), leftwards, look);
  return out;
}

// Clusters come by rising angle, but one may lie across the end of the circle.
void join(Thing& all, const Thing& part, const Look& look)
{
  if (all.points.empty())
  {
    all = part;
    return;
  }
  const double turn = look.towards(part.points.front()) - look.towards(all.points.front());
  if (math::wrapToPi(turn) > 0)
    all.left = part.left;
  else
    all.right = part.right;
  all.points.insert(all.points.end(), part.points.begin(), part.points.end());
  all.beams.insert(all.beams.end(), part.beams.begin(), part.beams.end());
}

double freePartOf(const std::vector<Point2D>& points, const Look& look, const FreeSpace& space)
{
  const auto isFree = [&](const Point2D& p)
  { return space.at(p, look.rangeOf(p), look.time) == Evidence::kFree; };
  return static_cast<double>(std::count_if(points.begin(), points.end(), isFree)) /
         static_cast<double>(points.size());
}
}  // namespace slamot::moving
