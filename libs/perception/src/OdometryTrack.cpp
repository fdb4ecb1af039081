#include <slamot/perception/OdometryTrack.h>

#include <algorithm>

namespace slamot::perception
{
void OdometryTrack::add(double time, const Pose2D& pose)
{
  last_ = pose;
  if (!points_.empty() && points_.back().time >= time)
    points_.back().pose = pose;
  else
    points_.push_back({time, pose});
}

Pose2D OdometryTrack::at(double time) const
{
  if (points_.empty()) return last_;
  const auto after = std::lower_bound(points_.begin(), points_.end(), time,
                                      [](const Point& p, double t) { return p.time < t; });
  if (after == points_.begin()) return after->pose;
  if (after == points_.end()) return points_.back().pose;
  const Point& before = *(after - 1);
  const double part = (time - before.time) / (after->time - before.time);
  const Pose2D step = math::between(before.pose, after->pose);
  return math::compose(before.pose, {part * step.x, part * step.y, part * step.phi});
}

void OdometryTrack::forgetBefore(double time)
{
  while (points_.size() > 1 && points_[1].time <= time) points_.pop_front();
}
}  // namespace slamot::perception
