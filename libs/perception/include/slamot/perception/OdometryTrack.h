#pragma once

#include <slamot/math/geometry.h>

#include <deque>

namespace slamot::perception
{
/// Where wheels say that the robot was, lately.
class OdometryTrack
{
 public:
  /// In the order of times; of equal times the last holds.
  void add(double time, const Pose2D& pose);
  /// The pose [m, rad] at a time [s], interpolated; at the ends held.  At the origin while nothing
  /// is known.
  [[nodiscard]] Pose2D at(double time) const;
  /// \returns the robot's pose at time `b`, seen from where it was at time `a`.
  [[nodiscard]] Pose2D between(double a, double b) const { return math::between(at(a), at(b)); }
  /// Keeps what is needed from this time on.
  void forgetBefore(double time);
  /// The newest pose that was added.
  [[nodiscard]] const Pose2D& last() const { return last_; }

 private:
  struct Point
  {
    double time;
    Pose2D pose;
  };
  std::deque<Point> points_;
  Pose2D last_;
};
}  // namespace slamot::perception
