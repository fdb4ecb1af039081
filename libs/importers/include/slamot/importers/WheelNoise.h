#pragma once

#include <slamot/math/gaussian.h>

namespace slamot::importers
{
/// How far wheel odometry errs: random walks of the distance driven and of the heading, in time and
/// in the angle turned.  So the error over a drive does not depend on how it is cut into steps.
struct WheelNoise
{
  double distance = 0;         ///< [m/sqrt(s)]
  double distanceTurning = 0;  ///< [m/sqrt(rad)], per root of the angle turned
  double heading = 0;          ///< [rad/sqrt(s)]
  double headingTurning = 0;   ///< [rad/sqrt(rad)]

  /// The motion at velocities v [m/s] and omega [rad/s], held over dt > 0 [s]: an arc, with the
  /// covariance of a step that turns, then moves.
  [[nodiscard]] Gaussian<Pose2D> held(double v, double omega, double dt) const;
};
}  // namespace slamot::importers
