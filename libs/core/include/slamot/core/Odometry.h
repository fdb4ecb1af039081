#pragma once

#include <slamot/core/Params.h>
#include <slamot/core/Step.h>

namespace slamot::core
{
/// How uncertain odometry is: as the log says, or by deviations of the robot's velocities, drawn
/// anew each step.  Section [odometer].
struct OdometryModel
{
  bool fromLog = true;  ///< take the log's covariances; the deviations below are then not looked at
  double vStd = 0;      ///< [m/s]
  double omegaStd = 0;  ///< [rad/s]
  double vScaleStd = 0;      ///< part of the speed
  double omegaScaleStd = 0;  ///< part of the turn rate

  /// Reads `noise` (log | model), `v_std_mps`, `omega_std_deg_per_s`, `v_scale_std`,
  /// `omega_scale_std`. \throws Error (kConfig)
  static OdometryModel from(Params& p);

  /// The increment with the model's covariance, over dt [s].
  [[nodiscard]] Gaussian<Pose2D> apply(const Gaussian<Pose2D>& increment, double dt) const;
};
}  // namespace slamot::core
