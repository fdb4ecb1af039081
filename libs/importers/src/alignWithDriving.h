#pragma once

#include <slamot/eval/Trajectory.h>

#include <optional>

namespace slamot::importers
{
/// How a car's logged heading lies to the way it drives.
struct DrivingDirection
{
  double ahead = 0;     ///< of the tracked point, from the one that never slides sideways [m]
  double turn = 0;      ///< to be added to logged headings [rad]
  double residual = 0;  ///< root mean square of the sideways speed that is left [m/s]
};

/// Least squares of the tracked point's sideways speed, turn v + ahead omega, where the car drives
/// at 0.2 m/s or faster; speeds are those over 0.2 s.  None if it hardly does.
[[nodiscard]] std::optional<DrivingDirection> drivingDirection(const eval::Trajectory& path);
}  // namespace slamot::importers
