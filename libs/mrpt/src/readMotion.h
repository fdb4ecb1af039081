#pragma once

#include "Entry.h"

#include <mrpt/obs/CActionRobotMovement2D.h>
#include <slamot/math/gaussian.h>

#include <optional>

namespace slamot::mrpt
{
/// The increment of an action: its stored PDF, or for emOdometry that of its motion model.  Of
/// Thrun's model, for which MRPT draws particles from its global generator, the exact mean and
/// covariance. \throws core::Error (kNonsense) if it is not finite.
[[nodiscard]] Gaussian<Pose2D> incrementOf(const ::mrpt::obs::CActionRobotMovement2D& action,
                                           const Entry& entry);

/// The movement among an entry's actions: scan matching before odometry, as MRPT chooses; none if
/// the robot did not report any.  \throws core::Error (kUnreadable) for a movement in 3D.
[[nodiscard]] std::shared_ptr<const ::mrpt::obs::CActionRobotMovement2D> movementAmong(
    const Entry& actions);
}  // namespace slamot::mrpt
