#pragma once

#include <slamot/models/DampedVelocityTarget.h>
#include <slamot/models/DifferentialDriveTarget.h>
#include <slamot/models/PolynomialTarget.h>

#include <variant>

namespace slamot::models
{
/// The motion model that the key `target_motion` names.
using TargetMotion = std::variant<DifferentialDriveTarget, DampedVelocityTarget,
                                  ConstantVelocityTarget, ConstantAccelerationTarget>;
[[nodiscard]] TargetMotion targetMotionFrom(core::Params& p,
                                            const std::string& otherwise = "damped-velocity");
}  // namespace slamot::models
