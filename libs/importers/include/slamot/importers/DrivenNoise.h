#pragma once

#include <slamot/math/gaussian.h>

namespace slamot::importers
{
/// How far increments of odometry err: random walks in the distance driven and in the angle turned,
/// none at rest.  So the error over a straight drive does not depend on how it is cut into steps.
struct DrivenNoise
{
  double distance = 0;         ///< along the motion [m/sqrt(m)]
  double slip = 0;             ///< across it [m/sqrt(m)]
  double distanceTurning = 0;  ///< both [m/sqrt(rad)], per root of the angle turned
  double heading = 0;          ///< [rad/sqrt(m)]
  double headingTurning = 0;   ///< [rad/sqrt(rad)]

  /// The increment with its covariance, in the frame of its start.
  [[nodiscard]] Gaussian<Pose2D> of(const Pose2D& increment) const;
};
}  // namespace slamot::importers
