#include <slamot/eval/Trajectory.h>

#include <algorithm>
#include <cmath>

#include "sameTime.h"

namespace slamot::eval
{
std::optional<TimedPose> Trajectory::at(double time, double maxGap) const
{
  const auto earlier = [](const TimedPose& p, double t) { return p.time < t; };
  auto after = std::lower_bound(poses.begin(), poses.end(), time - kSameTime, earlier);
  if (after == poses.end()) return std::nullopt;
  if (after->time <= time + kSameTime)
  {
    // Rows of a log whose clock stands still are closer than that.
    while (std::next(after) != poses.end() &&
           std::abs(std::next(after)->time - time) < std::abs(after->time - time))
      ++after;
    return *after;
  }
  if (after == poses.begin()) return std::nullopt;
  const TimedPose &a = *std::prev(after), &b = *after;
  if (b.time - a.time > maxGap) return std::nullopt;
  const double f = (time - a.time) / (b.time - a.time);
  return TimedPose{time,
                   {a.pose.x + f * (b.pose.x - a.pose.x), a.pose.y + f * (b.pose.y - a.pose.y),
                    math::wrapToPi(a.pose.phi + f * math::wrapToPi(b.pose.phi - a.pose.phi))},
                   a.headingKnown && b.headingKnown};
}
}  // namespace slamot::eval
