#pragma once

#include <slamot/models/DampedVelocityTarget.h>
#include <slamot/models/DifferentialDriveTarget.h>
#include <slamot/models/ManoeuvringTarget.h>
#include <slamot/models/PolynomialTarget.h>

#include <variant>

namespace slamot::models
{
/// The motion model that the key `target_motion` names.
using TargetMotion =
    std::variant<DifferentialDriveTarget, DampedVelocityTarget, ConstantVelocityTarget,
                 ConstantAccelerationTarget, ManoeuvringTarget>;
/// Whether a model of motion is a bank of several.
template <class Motion>
inline constexpr bool kHasModes = std::is_same_v<Motion, ManoeuvringTarget>;
/// Reads `target_motion`, or takes `otherwise`, and the keys of that model; those of the others are
/// left alone. \throws core::Error (kConfig)
[[nodiscard]] TargetMotion targetMotionFrom(core::Params& p,
                                            const std::string& otherwise = "damped-velocity");
}  // namespace slamot::models
