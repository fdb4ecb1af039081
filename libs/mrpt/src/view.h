#pragma once

namespace slamot::mrpt
{
/// MRPT's camera without perspective shows half its zoom distance on the shorter side.
inline constexpr double kOrthogonalZoom = 2;

/// The part of a picture's width that the legend takes, and of its height that the title takes.
inline constexpr double kLegendPart = 0.24, kTitlePart = 0.063;

/// Where the left border of the legend's and the title's viewports is, in their own units.
inline constexpr double kOverlayLeft = -0.3;

struct Box
{
  double xMin, xMax, yMin, yMax;  ///< [m], on the ground
};

/// What a camera that looks along +y, tilted down, shows.
struct CameraView
{
  double x = 0, y = 0;   ///< the ground's point in the picture's middle [m]
  double span = 1;       ///< shown from top to bottom, there [m]
  double elevation = 0;  ///< [rad]
  double opening = 0;    ///< from top to bottom [rad]; 0: no perspective

  /// The camera's distance; [m], infinite without perspective.
  [[nodiscard]] double distance() const;
};

struct ScreenPoint
{
  double x, y;  ///< -1 (left, bottom) to 1 (right, top)
};

/// Where a point on the ground is seen; aspect: the picture's width by its height.
[[nodiscard]] ScreenPoint project(const CameraView& view, double aspect, double x, double y);

/// The view, as near as may be, that has all of a box beside the legend and below the title.
[[nodiscard]] CameraView fitted(CameraView view, double aspect, const Box& box);
}  // namespace slamot::mrpt
