#pragma once

#include <slamot/scans/PoseGraph.h>

namespace slamot::scans
{
/// What was seen at a node of the graph.
struct Keyframe
{
  std::vector<Point2D> points;  ///< [m], in the robot's frame
  double path = 0;              ///< [m] driven until here
};

/// Keyframe i was taken at node i.
using Keyframes = std::vector<Keyframe>;

/// What keyframes `first` to `last` saw, in the axes of `frame`.
[[nodiscard]] std::vector<Point2D> pointsOf(const Keyframes& keyframes, const PoseGraph& graph,
                                            std::size_t first, std::size_t last,
                                            const Pose2D& frame);

/// The keyframes around `node`, at most `stretch` [m] of path, and sixty, before
/// and after.
[[nodiscard]] std::pair<std::size_t, std::size_t> around(const Keyframes& keyframes,
                                                         std::size_t node, double stretch);
}  // namespace slamot::scans
