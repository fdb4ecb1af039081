#include "layout.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace slamot::results
{
namespace
{
constexpr int kLeft = 88, kRight = 18, kTitle = 26, kLegendRow = 24, kGap = 12, kAxisFoot = 56;

/// Grows by what is finite and, on a logarithmic axis, positive.
void cover(Range& range, const std::vector<double>& values, bool logarithmic)
{
  for (const double v : values)
  {
    if (!std::isfinite(v) || (logarithmic && v <= 0)) continue;
    range.min = std::min(range.min, v);
    range.max = std::max(range.max, v);
  }
}

/// A range that gnuplot can draw, with a margin of `room` of its length.
Range widened(Range r, bool logarithmic, double room)
{
  if (r.min > r.max) r = logarithmic ? Range{0.1, 10} : Range{0, 1};
  if (logarithmic)
  {
    const double factor = std::max(std::pow(r.max / r.min, room), r.max > r.min ? 1.0 : 2.0);
    return {r.min / factor, r.max * factor};
  }
  const double length = r.max - r.min;
  const double smallest = 1e-9 * std::max({1.0, std::abs(r.min), std::abs(r.max)});
  const double margin = length > smallest ? room * length : std::max(0.5, smallest);
  return {r.min - margin, r.max + margin};
}

Range autoRange(const Plot& plot, bool ofX, double room)
{
  Range r{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  const bool logarithmic = ofX ? plot.logX : plot.logY;
  for (const Series& s : plot.series)
  {
    cover(r, ofX ? s.x : s.y, logarithmic);
    if (!ofX) cover(r, s.low, logarithmic), cover(r, s.high, logarithmic);
  }
  return widened(r, logarithmic, room);
}

Range rangeOf(const Plot& plot, bool ofX)
{
  const auto& fixed = ofX ? plot.xRange : plot.yRange;
  if (fixed) return *fixed;
  return autoRange(plot, ofX, plot.equalAxes ? 0.04 : ofX && !plot.logX ? 0.0 : 0.06);
}

/// The drawing area's height, after growing one axis until a metre is as long on both.
int equalise(PanelLayout& p, int width)
{
  const double lx = p.x.max - p.x.min, ly = p.y.max - p.y.min;
  const double aspect = std::clamp(ly / lx, 0.35, 1.2);
  const auto grow = [](Range& r, double length)
  {
    const double centre = (r.min + r.max) / 2;
    r = {centre - length / 2, centre + length / 2};
  };
  const int height = static_cast<int>(std::lround(width * aspect));
  const double metrePerPixel = std::max(lx / width, ly / height);
  grow(p.x, metrePerPixel * width);
  grow(p.y, metrePerPixel * height);
  return height;
}

/// Columns and rows of a legend whose entries are as wide as the longest; gnuplot takes 9.1 px for
/// a letter, whatever it is, and breaks rows by that.
int legendRows(const Plot& plot, int width, int& columns)
{
  std::size_t entries = 0, longest = 0;
  for (const Series& s : plot.series)
    if (!s.title.empty()) ++entries, longest = std::max(longest, s.title.size());
  const int entryWidth = 56 + static_cast<int>(std::ceil(9.1 * static_cast<double>(longest)));
  columns = std::max(1, std::min(static_cast<int>(entries), width / entryWidth));
  return (static_cast<int>(entries) + columns - 1) / columns;
}
}  // namespace

Layout layOut(const Figure& figure)
{
  Layout layout;
  layout.width = figure.width;
  int y = 6;
  for (std::size_t i = 0; i < figure.panels.size(); ++i)
  {
    const Plot& plot = figure.panels[i];
    PanelLayout p;
    p.left = kLeft, p.right = figure.width - kRight;
    p.x = i == 0 ? rangeOf(plot, true) : layout.panels.front().x;
    p.y = rangeOf(plot, false);
    const int width = p.right - p.left;
    const int height = plot.equalAxes ? equalise(p, width) : figure.panelHeight;
    if (!plot.title.empty()) y += kTitle;
    p.legendTop = y;
    y += kLegendRow * legendRows(plot, width, p.legendColumns) + 4;
    p.top = y;
    p.bottom = y + height;
    p.showXAxis = i + 1 == figure.panels.size();
    y = p.bottom + (p.showXAxis ? kAxisFoot : kGap);
    layout.panels.push_back(p);
  }
  layout.height = y;
  return layout;
}
}  // namespace slamot::results
