#pragma once

#include <slamot/scans/PoseGraph.h>

namespace slamot::scans
{
/// The pose `from` measured from `to`, in the axes of `from`, turned round: of `to` from `from`.
[[nodiscard]] Gaussian<Pose2D> inverse(const Gaussian<Pose2D>& pose);

/// Every node's pose from `node` with its covariance, along the least uncertain chain of relations:
/// never less than what all relations together leave, and found without solving for them.
/// Bosse et al., "Simultaneous localization and map building in large-scale cyclic environments
/// using the Atlas framework", 2004.  Means are those of the graph's poses.
[[nodiscard]] std::vector<Gaussian<Pose2D>> reachFrom(const PoseGraph& graph, std::size_t node);
}  // namespace slamot::scans
