#include "view.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace slamot::mrpt
{
namespace
{
constexpr double kMargin = 0.02;  // of the picture, on every side
constexpr double kLeft = -1 + 2 * kMargin, kRight = 1 - 2 * kLegendPart - 2 * kMargin;
constexpr double kBottom = -1 + 2 * kMargin, kTop = 1 - 2 * kTitlePart - 2 * kMargin;

/// The box as seen.
Box projected(const CameraView& view, double aspect, const Box& box)
{
  Box seen{1e300, -1e300, 1e300, -1e300};
  for (const double x : {box.xMin, box.xMax})
    for (const double y : {box.yMin, box.yMax})
    {
      const ScreenPoint p = project(view, aspect, x, y);
      seen = {std::min(seen.xMin, p.x), std::max(seen.xMax, p.x), std::min(seen.yMin, p.y),
              std::max(seen.yMax, p.y)};
    }
  return seen;
}
}  // namespace

double CameraView::distance() const
{
  return opening > 0 ? span / 2 / std::tan(opening / 2) : std::numeric_limits<double>::infinity();
}

ScreenPoint project(const CameraView& view, double aspect, double x, double y)
{
  const double dx = x - view.x, dy = y - view.y;
  const double nearer = 1 / (1 + dy * std::cos(view.elevation) / view.distance());
  return {2 * dx * nearer / (view.span * aspect),
          2 * dy * std::sin(view.elevation) * nearer / view.span};
}

CameraView fitted(CameraView view, double aspect, const Box& box)
{
  view.x = (box.xMin + box.xMax) / 2, view.y = (box.yMin + box.yMax) / 2;
  view.span = 4 * std::max({box.xMax - box.xMin, box.yMax - box.yMin, 1e-3});
  for (int round = 0; round < 60; ++round)
  {
    const Box seen = projected(view, aspect, box);
    const double grow = std::max((seen.xMax - seen.xMin) / (kRight - kLeft),
                                 (seen.yMax - seen.yMin) / (kTop - kBottom));
    const double offX = (seen.xMin + seen.xMax - kLeft - kRight) / 2;
    const double offY = (seen.yMin + seen.yMax - kBottom - kTop) / 2;
    view.x += offX * view.span * aspect / 2;
    view.y += offY * view.span / 2 / std::sin(view.elevation);
    view.span *= 0.5 + 0.5 * grow;  // half the way: perspective makes it overshoot
  }
  return view;
}
}  // namespace slamot::mrpt
