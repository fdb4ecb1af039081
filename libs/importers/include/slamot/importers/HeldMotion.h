#pragma once

#include <slamot/math/gaussian.h>

namespace slamot::importers
{
/// One step of odometry whose velocity is held, to be cut where a sensor reported within it.
class HeldMotion
{
 public:
  /// A robot that turns by omega dt, then moves by v dt, with deviations of both velocities.
  /// Cut at tau, it has turned by omega tau and moved by v tau along its heading there.
  static HeldMotion fromVelocities(double v, double omega, double dt, double stdV, double stdOmega);
  /// An increment in the frame of its start; cut, it is an arc of constant curvature.
  static HeldMotion fromIncrement(const Gaussian<Pose2D>& whole);

  /// The increment over the whole step, in the frame of its start.
  [[nodiscard]] const Gaussian<Pose2D>& whole() const { return whole_; }

  /// The increment between two shares of the duration, 0 <= from <= to <= 1, in the frame of its
  /// own start.  Variance goes in proportion to duration: composed, the parts of any partition give
  /// the whole's mean and covariance, exactly.
  [[nodiscard]] Gaussian<Pose2D> part(double from, double to) const;

 private:
  [[nodiscard]] Pose2D at(double share) const;

  Gaussian<Pose2D> whole_;
  double first_ = 0, second_ = 0, turn_ = 0;  // velocity times duration
  bool turnsFirst_ = false;
};
}  // namespace slamot::importers
