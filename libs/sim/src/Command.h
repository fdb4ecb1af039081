#pragma once

#include <slamot/math/gaussian.h>
#include <slamot/sim/Motion.h>

namespace slamot::sim
{
/// What a body is told to do over the next step.
struct Command
{
  double v = 0;     ///< [m/s]
  double turn = 0;  ///< turn rate omega [rad/s], or the wheel's angle G [rad]: see Motion::Drive
};

/// What it then does in a step of dt [s], in its own frame: without noise, and the covariance that
/// the noise of its controls gives it, to first order.
[[nodiscard]] Gaussian<Pose2D> increment(const Motion& motion, const Command& command, double dt);
}  // namespace slamot::sim
