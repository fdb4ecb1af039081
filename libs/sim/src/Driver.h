#pragma once

#include "Command.h"

#include <slamot/math/random.h>
#include <slamot/sim/Scenario.h>

namespace slamot::sim
{
/// Drives one body by its own motion.
class Driver
{
 public:
  /// \param turns draws the times of a manoeuvre's changes.
  Driver(const Motion& motion, const Area& area, const math::RandomStream& turns);

  /// \param pose where it is, \param elapsed since the start [s]; rising from call to call.
  [[nodiscard]] Command next(const Pose2D& pose, double elapsed);

 private:
  [[nodiscard]] Command toWaypoint(const Pose2D& pose, double elapsed);
  [[nodiscard]] double turnWheel(double to, double elapsed);
  [[nodiscard]] Command manoeuvre(const Pose2D& pose, double elapsed);

  Motion motion_;
  Area area_;
  math::RandomStream turns_;
  std::size_t waypoint_ = 0;
  double turn_ = 1, nextSwitch_ = 0;
  double wheel_ = 0, wheelTime_ = 0;  // the wheel's angle as told last, and when
};

/// Drives a robot after a point beside a target: the nearer the slower, stopping at the distance to
/// keep.  The point lies setup.followSide to the left of the target, across the target's heading.
/// \param targetSpeed the speed that the target is told to drive at [m/s].
[[nodiscard]] Command follow(const RobotSetup& setup, const Pose2D& robot, const Pose2D& target,
                             double targetSpeed);
}  // namespace slamot::sim
