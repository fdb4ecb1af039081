#pragma once

#include <slamot/math/geometry.h>

#include <vector>

namespace slamot::eval
{
/// Places of points in two sets.
struct Group
{
  std::vector<std::size_t> first, second;  ///< rising
};

/// The points that have one of the other set nearer than `distance`, in groups: whatever is that
/// near is in the same group.  In the order of their first points.
/// \param distance [m], > 0.  \throws std::domain_error for a point that is not finite.
[[nodiscard]] std::vector<Group> groupsWithin(double distance, const std::vector<Point2D>& first,
                                              const std::vector<Point2D>& second);
}  // namespace slamot::eval
