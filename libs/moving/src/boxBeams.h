#pragma once

#include <optional>
#include <vector>

#include "BoxState.h"

namespace slamot::moving
{
/// The direction in which a thing ends, and how well it is known [rad].
struct End
{
  double bearing, std;
};

/// What one scan shows of one thing, in the state's axes.
struct BoxView
{
  Point2D laser;                   ///< [m]
  std::vector<Point2D> points;     ///< returns [m]
  std::optional<End> right, left;  ///< where it ends; none where something hides that
};

/// One number that is zero where box and view agree, with its derivative by the state.
struct Residual
{
  double value = 0, variance = 0;
  BoxState::Vector jacobian = BoxState::Vector::Zero();
};

/// A return lies on the face that its beam meets; the directions in which the thing ends are those
/// of the box's outermost corners.  Returns on one face share an error of `shapeStd`, since a thing
/// is no rectangle.
[[nodiscard]] std::vector<Residual> residualsOf(const BoxState& box, const BoxView& view,
                                                const MovingOptions& options);

/// How far a point is from the box's outline, outside or inside [m].
[[nodiscard]] double distanceToOutline(const BoxState& box, const Point2D& p);

[[nodiscard]] Point2D nearestOnOutline(const BoxState& box, const Point2D& p);

/// The point in the box's axes: x ahead, y to the left, from its middle [m].
[[nodiscard]] Point2D inBox(const BoxState& box, const Point2D& p);
}  // namespace slamot::moving
