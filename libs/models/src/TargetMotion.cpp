#include <slamot/models/TargetMotion.h>

namespace slamot::models
{
TargetMotion targetMotionFrom(core::Params& p, const std::string& otherwise)
{
  // Keys of the models that were not chosen are known, so that --set can change the choice.
  p.allowUnused({"target_velocity_std_mps", "target_velocity_time_s",
                 "target_acceleration_std_mps2", "target_acceleration_noise_mps2_per_sqrt_hz",
                 "target_jerk_noise_mps3_per_sqrt_hz", "target_step_acceleration_std_mps2",
                 "target_speed_mps", "target_speed_std_mps", "target_turn_rate_deg_per_s",
                 "target_turn_rate_std_deg_per_s", "target_speed_noise_mps",
                 "target_turn_rate_noise_deg_per_s", "target_speed_walk_mps_per_sqrt_s",
                 "target_turn_rate_walk_deg_per_s_per_sqrt_s", "target_modes", "target_mode_time_s",
                 "target_heading_walk_deg_per_sqrt_s", "target_velocity_noise_mps_per_sqrt_hz"});
  const std::string motion = p.choice("target_motion",
                                      {"differential-drive", "damped-velocity", "constant-velocity",
                                       "constant-acceleration", "manoeuvring"},
                                      otherwise);
  if (motion == "differential-drive")
    return DifferentialDriveTarget(DifferentialDriveTarget::Params::from(p));
  if (motion == "damped-velocity")
    return DampedVelocityTarget(DampedVelocityTarget::Params::from(p));
  if (motion == "constant-velocity")
    return ConstantVelocityTarget(ConstantVelocityTarget::Params::from(p));
  if (motion == "manoeuvring") return ManoeuvringTarget(ManoeuvringTarget::Params::from(p));
  return ConstantAccelerationTarget(ConstantAccelerationTarget::Params::from(p));
}
}  // namespace slamot::models
