#pragma once

#include <slamot/math/gaussian.h>

#include <optional>

namespace slamot::scans
{
/// Odometry that comes after a scan tells again of the motion up to it, which matching has found
/// already: only what came later is new.
class OdometryShare
{
 public:
  /// A scan of this time [s] put the robot where it was then.
  void matched(double time) { until_ = time; }

  /// The part of an increment, which ends at this time, that is new; the motion is taken as even.
  [[nodiscard]] Gaussian<Pose2D> next(Gaussian<Pose2D> increment, double time)
  {
    const auto from = last_, until = until_;
    last_ = time;
    until_.reset();
    if (!from || !until || *until <= *from || time <= *from) return increment;
    const double share = *until < time ? (time - *until) / (time - *from) : 0.0;
    increment.mean.x *= share;
    increment.mean.y *= share;
    increment.mean.phi *= share;
    increment.cov *= share;
    return increment;
  }

 private:
  std::optional<double> last_, until_;  // of odometry, and of the last scan matched since [s]
};
}  // namespace slamot::scans
