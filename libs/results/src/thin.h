#pragma once

#include <slamot/results/Plot.h>

namespace slamot::results
{
/// How a panel's numbers become pixels.
struct PixelScale
{
  double x0 = 0, y0 = 0, perX = 1, perY = 1;  ///< pixel = (value or its log10 - x0) * perX
  bool logX = false, logY = false;

  [[nodiscard]] double x(double v) const;
  [[nodiscard]] double y(double v) const;
};

/// The series without the points that nobody could see: lines stay within a third of a pixel
/// (three where they would have very many corners), dense curves and bands keep the extremes of
/// every column of pixels, and marks in one pixel are drawn once.
[[nodiscard]] Series thinned(const Series& series, const PixelScale& scale);
}  // namespace slamot::results
