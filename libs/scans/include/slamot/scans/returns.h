#pragma once

#include <slamot/core/Step.h>

namespace slamot::scans
{
/// Where a beam ended.
struct Return
{
  Point2D point;         ///< [m], in the robot's frame
  std::size_t beam = 0;  ///< its place among all beams of a step, one laser after another
};

/// The returns of one step's lasers nearer than `farthest` [m].  What is no number, not above zero,
/// or not below the laser's own limit is no return.
[[nodiscard]] std::vector<Return> returnsOf(
    const std::vector<std::shared_ptr<const core::LaserScan>>& lasers, double farthest);

/// At most one point for each square of `cell` [m], the first that fell into it: near walls, which
/// most beams hit, then count no more than far ones.
[[nodiscard]] std::vector<Point2D> thinned(const std::vector<Point2D>& points, double cell);
}  // namespace slamot::scans
