#pragma once

#include <slamot/math/geometry.h>

#include <optional>
#include <vector>

namespace slamot::eval
{
/// A pose at a time [s]; `headingKnown` is false where only the place is known.
struct TimedPose
{
  double time = 0;                       ///< [s]
  Pose2D pose;                           ///< in the trajectory's own frame
  bool headingKnown = true;              ///< else pose.phi is 0 and means nothing
  std::optional<Vector2> velocity = {};  ///< [m/s]; none: the path alone tells it
};

/// Poses in rising order of time.
struct Trajectory
{
  std::vector<TimedPose> poses;  ///< by rising times

  /// The pose at a time, linear between neighbours (heading along the shorter turn); none outside
  /// the span, or within a gap longer than maxGap [s].
  [[nodiscard]] std::optional<TimedPose> at(double time, double maxGap = 1e9) const;
  /// Whether there is no pose at all.
  [[nodiscard]] bool empty() const { return poses.empty(); }
};
}  // namespace slamot::eval
