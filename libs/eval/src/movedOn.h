#pragma once

#include <slamot/math/geometry.h>

#include <cmath>

namespace slamot::eval
{
/// Whether a robot has moved on far enough for another of its scans to be kept.
[[nodiscard]] inline bool movedOn(const Pose2D& from, const Pose2D& to)
{
  constexpr double kDistance = 0.1;            // [m]
  constexpr double kTurn = math::degToRad(5);  // [rad]
  const Pose2D moved = math::between(from, to);
  return std::hypot(moved.x, moved.y) >= kDistance || std::abs(moved.phi) >= kTurn;
}
}  // namespace slamot::eval
