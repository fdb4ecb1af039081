#pragma once

#include <slamot/core/Filter.h>

namespace slamot::laws
{
/// A belief that outlives the filter's next step.
struct Snapshot
{
  core::Estimate estimate;  // without the view
  std::vector<core::LandmarkEstimate> landmarks;
};
[[nodiscard]] Snapshot snapshot(const core::Estimate& estimate);

/// The snapshot moved and rotated by a pose.
[[nodiscard]] Snapshot moved(const Snapshot& snapshot, const Pose2D& pose_new_old);

/// Empty if two beliefs agree to `tolerance`, relative for numbers above 1; else what differs.
[[nodiscard]] std::string difference(const Snapshot& a, const Snapshot& b, double tolerance);

/// All that a filter believes and tells, bit by bit.
[[nodiscard]] std::string bytes(const core::Filter& filter);
[[nodiscard]] std::string bytes(const core::Update& update);
}  // namespace slamot::laws
