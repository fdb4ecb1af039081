#include "thin.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace slamot::results
{
namespace
{
constexpr double kTolerance = 0.33;  // [px]
constexpr double kColumn = 1;        // [px]
constexpr std::size_t kManyPoints = 4000;
constexpr std::size_t kMostPoints = 5000;  // of one line

struct Pixel
{
  double x, y;
};

double distanceToChord(const Pixel& p, const Pixel& a, const Pixel& b)
{
  const double dx = b.x - a.x, dy = b.y - a.y, length2 = dx * dx + dy * dy;
  const double t =
      length2 > 0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / length2, 0.0, 1.0) : 0.0;
  return std::hypot(p.x - a.x - t * dx, p.y - a.y - t * dy);
}

/// Marks what Ramer, Douglas and Peucker would keep between two points that are kept.
void markCorners(const std::vector<Pixel>& p, std::size_t first, std::size_t last, double tolerance,
                 std::vector<char>& keep)
{
  std::vector<std::pair<std::size_t, std::size_t>> open{{first, last}};
  while (!open.empty())
  {
    const auto [a, b] = open.back();
    open.pop_back();
    double worst = tolerance;
    std::size_t split = 0;
    for (std::size_t i = a + 1; i < b; ++i)
      if (const double d = distanceToChord(p[i], p[a], p[b]); d > worst) worst = d, split = i;
    if (split == 0) continue;
    keep[split] = 1;
    open.push_back({a, split});
    open.push_back({split, b});
  }
}

Series select(const Series& s, const std::vector<std::size_t>& kept)
{
  Series out;
  out.kind = s.kind, out.title = s.title, out.ink = s.ink;
  const auto take = [&](const std::vector<double>& from, std::vector<double>& to)
  {
    if (from.empty()) return;
    for (const std::size_t i : kept) to.push_back(from[i]);
  };
  take(s.x, out.x), take(s.y, out.y), take(s.low, out.low), take(s.high, out.high);
  return out;
}

/// Of every run of points in one pixel column, the first, lowest, highest and last.
std::vector<std::size_t> columnExtremes(const std::vector<double>& x, const std::vector<double>& y)
{
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < x.size();)
  {
    std::size_t end = i + 1, low = i, high = i;
    const double column = std::floor(x[i] / kColumn);
    const auto belongs = [&](std::size_t k)
    { return std::floor(x[k] / kColumn) == column && std::isnan(y[k]) == std::isnan(y[i]); };
    for (; end < x.size() && belongs(end); ++end)
    {
      if (y[end] < y[low]) low = end;
      if (y[end] > y[high]) high = end;
    }
    for (const std::size_t k : std::set<std::size_t>{i, low, high, end - 1}) kept.push_back(k);
    i = end;
  }
  return kept;
}

/// The places to keep of a line that may have gaps.
std::vector<std::size_t> corners(const std::vector<Pixel>& pixels, double tolerance)
{
  const auto broken = [&](std::size_t i)
  { return !std::isfinite(pixels[i].x) || !std::isfinite(pixels[i].y); };
  std::vector<char> keep(pixels.size(), 0);
  for (std::size_t i = 0; i < pixels.size();)
  {
    std::size_t end = i;
    while (end < pixels.size() && !broken(end)) ++end;
    if (end > i)
    {
      keep[i] = keep[end - 1] = 1;
      markCorners(pixels, i, end - 1, tolerance, keep);
    }
    if (end < pixels.size()) keep[end] = 1;  // the gap itself
    i = end + 1;
  }
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < keep.size(); ++i)
    if (keep[i]) kept.push_back(i);
  return kept;
}

Series thinnedLine(const Series& s, const PixelScale& scale)
{
  std::vector<Pixel> pixels;
  for (std::size_t i = 0; i < s.x.size(); ++i) pixels.push_back({scale.x(s.x[i]), scale.y(s.y[i])});
  std::vector<std::size_t> kept = corners(pixels, kTolerance);
  for (double tolerance = 1.5 * kTolerance; kept.size() > kMostPoints && tolerance < 3;
       tolerance *= 1.5)
    kept = corners(pixels, tolerance);
  return select(s, kept);
}

Series thinnedColumns(const Series& s, const PixelScale& scale, const std::vector<double>& y)
{
  std::vector<double> x;
  for (const double v : s.x) x.push_back(scale.x(v));
  return select(s, columnExtremes(x, y));
}

Series thinnedBand(const Series& s, const PixelScale& scale)
{
  std::vector<double> width;
  for (std::size_t i = 0; i < s.x.size(); ++i) width.push_back(s.high[i] - s.low[i]);
  return thinnedColumns(s, scale, width);
}

Series thinnedMarks(const Series& s, const PixelScale& scale)
{
  std::set<std::pair<long, long>> taken;
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < s.x.size(); ++i)
  {
    const double x = scale.x(s.x[i]), y = s.y.empty() ? 0.0 : scale.y(s.y[i]);
    if (!std::isfinite(x) || !std::isfinite(y)) continue;
    if (taken.insert({std::lround(x / kColumn), std::lround(y / kColumn)}).second)
      kept.push_back(i);
  }
  return select(s, kept);
}

/// Whether a series runs from left to right with far more points than columns.
bool isDenseCurve(const Series& s, const PixelScale& scale)
{
  if (s.x.size() < kManyPoints || !std::is_sorted(s.x.begin(), s.x.end())) return false;
  const double columns = (scale.x(s.x.back()) - scale.x(s.x.front())) / kColumn;
  return static_cast<double>(s.x.size()) > 2 * columns;
}
}  // namespace

double PixelScale::x(double v) const
{
  return ((logX ? std::log10(v) : v) - x0) * perX;
}
double PixelScale::y(double v) const
{
  return ((logY ? std::log10(v) : v) - y0) * perY;
}

Series thinned(const Series& s, const PixelScale& scale)
{
  switch (s.kind)
  {
    case Series::Kind::kLine:
    case Series::Kind::kThin:
    case Series::Kind::kDashes:
      return thinnedLine(isDenseCurve(s, scale) ? thinnedColumns(s, scale, s.y) : s, scale);
    case Series::Kind::kBand:
      return s.x.size() > kManyPoints ? thinnedBand(s, scale) : s;
    case Series::Kind::kDots:
    case Series::Kind::kPoints:
    case Series::Kind::kCrosses:
    case Series::Kind::kTicks:
      return thinnedMarks(s, scale);
    case Series::Kind::kErrorBars:
    case Series::Kind::kShape:
    case Series::Kind::kSolid:
      break;
  }
  return s;
}
}  // namespace slamot::results
