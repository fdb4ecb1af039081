#pragma once

#include <slamot/results/Plot.h>

namespace slamot::results
{
/// Where a panel's drawing area lies [px from the left and from the top], and what it spans.
struct PanelLayout
{
  int left = 0, right = 0, top = 0, bottom = 0;
  Range x, y;
  int legendColumns = 1, legendTop = 0;
  bool showXAxis = true;
};

struct Layout
{
  int width = 0, height = 0;
  std::vector<PanelLayout> panels;
};

/// Sizes and ranges of a figure's panels: fixed here, so that the program that draws them has
/// nothing left to choose.
[[nodiscard]] Layout layOut(const Figure& figure);
}  // namespace slamot::results
