#include <slamot/scans/LocalMap.h>

#include <algorithm>
#include <limits>

namespace slamot::scans
{
namespace
{
constexpr int kReach = 6;          // cells: farther from everything, a point has no surface
constexpr int kNeighbourhood = 5;  // cells around one that its surface is fitted to
constexpr double kFieldStd = 0.1;  // [m]: of the likelihood
constexpr double kFlat = 0.3;      // a wall's deviation across it, by that along it
constexpr double kFewest = 4;      // points of a surface

template <class T>
T squared(T v)
{
  return v * v;
}
}  // namespace

/// Moments of the points of one cell, relative to the map's origin.
struct LocalMap::Sums
{
  int cellX = 0, cellY = 0;
  double n = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;

  void add(const Point2D& p)
  {
    n += 1, x += p.x, y += p.y;
    xx += p.x * p.x, xy += p.x * p.y, yy += p.y * p.y;
  }
  void add(const Sums& o) { n += o.n, x += o.x, y += o.y, xx += o.xx, xy += o.xy, yy += o.yy; }
};

LocalMap::LocalMap(const std::vector<Point2D>& points, double farthest)
{
  std::vector<Point2D> near;
  for (const Point2D& p : points)
    if (std::hypot(p.x, p.y) < farthest) near.push_back(p);
  if (near.empty()) return;
  enclose(near);
  const std::vector<Sums> cells = addUp(near);
  fitSurfaces(cells);
  field_ = BlockMaxima(spread(cells));
}

void LocalMap::enclose(const std::vector<Point2D>& points)
{
  Point2D lo = points.front(), hi = lo;
  for (const Point2D& p : points)
  {
    lo = {std::min(lo.x, p.x), std::min(lo.y, p.y)};
    hi = {std::max(hi.x, p.x), std::max(hi.y, p.y)};
  }
  constexpr int kMargin = kReach + 1;
  // Whole cells of a fixed grid: a map must not change with what happens to lie at its edge.
  origin_ = {(std::floor(lo.x / kCell) - kMargin) * kCell,
             (std::floor(lo.y / kCell) - kMargin) * kCell};
  const auto last = cellOf(hi);
  width_ = last[0] + kMargin + 1, height_ = last[1] + kMargin + 1;
}

/// Occupied cells in the order of their first points; nearest_ is their index meanwhile.
std::vector<LocalMap::Sums> LocalMap::addUp(const std::vector<Point2D>& points)
{
  std::vector<Sums> cells;
  nearest_.assign(index(0, height_), -1);
  for (const Point2D& p : points)
  {
    const auto [x, y] = cellOf(p);
    std::int32_t& at = nearest_[index(x, y)];
    if (at < 0)
    {
      at = static_cast<std::int32_t>(cells.size());
      cells.push_back(Sums{x, y});
    }
    cells[static_cast<std::size_t>(at)].add(Point2D{p.x - origin_.x, p.y - origin_.y});
  }
  return cells;
}

void LocalMap::fitSurfaces(const std::vector<Sums>& cells)
{
  for (const Sums& cell : cells)
  {
    Sums sum;
    const int x0 = std::max(0, cell.cellX - kNeighbourhood);
    const int x1 = std::min(width_ - 1, cell.cellX + kNeighbourhood);
    const int y0 = std::max(0, cell.cellY - kNeighbourhood);
    const int y1 = std::min(height_ - 1, cell.cellY + kNeighbourhood);
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x)
        if (const auto at = nearest_[index(x, y)]; at >= 0)
          if (squared(x - cell.cellX) + squared(y - cell.cellY) <= squared(kNeighbourhood))
            sum.add(cells[static_cast<std::size_t>(at)]);
    const double mx = sum.x / sum.n, my = sum.y / sum.n;
    const double a = sum.xx / sum.n - mx * mx, b = sum.xy / sum.n - mx * my;
    const double c = sum.yy / sum.n - my * my;
    const double half = (a + c) / 2, root = std::hypot((a - c) / 2, b);
    const double across = std::max(0.0, half - root), along = half + root;
    Surface s;
    // A lone point may lie anywhere along a wall that was seen at a slant: it tells nothing.
    s.isKnown = sum.n >= kFewest;
    s.isWall = s.isKnown && across < squared(kFlat) * along;
    s.centre = {origin_.x + mx, origin_.y + my};
    s.variance = across;
    s.tilt = across / (sum.n * along + 1e-12);
    const double direction = 0.5 * std::atan2(2 * b, a - c);
    s.normal = {-std::sin(direction), std::cos(direction)};
    if (!s.isWall)  // its own place says more than the middle of what is around it
    {
      s.centre = {origin_.x + cell.x / cell.n, origin_.y + cell.y / cell.n};
      s.variance = squared(kFieldStd);
    }
    surfaces_.push_back(s);
  }
}

BlockMaxima::Level LocalMap::spread(const std::vector<Sums>& cells)
{
  std::vector<int> distance(nearest_.size(), std::numeric_limits<int>::max());
  for (std::size_t i = 0; i < cells.size(); ++i)
    for (int dy = -kReach; dy <= kReach; ++dy)
      for (int dx = -kReach; dx <= kReach; ++dx)
      {
        const int d = dx * dx + dy * dy;
        const std::size_t at = index(cells[i].cellX + dx, cells[i].cellY + dy);
        if (d > kReach * kReach || d >= distance[at]) continue;
        distance[at] = d;
        nearest_[at] = static_cast<std::int32_t>(i);
      }
  std::array<std::uint8_t, kReach * kReach + 1> value{};
  for (std::size_t d = 0; d < value.size(); ++d)
    value[d] = static_cast<std::uint8_t>(
        std::lround(kHit * std::exp(-0.5 * static_cast<double>(d) * squared(kCell / kFieldStd))));
  BlockMaxima::Level field(width_, height_);
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x)
      if (const std::size_t at = index(x, y); nearest_[at] >= 0)
        field.value[field.index(x, y)] = value[static_cast<std::size_t>(distance[at])];
  return field;
}

const Surface* LocalMap::nearest(const Point2D& p) const
{
  const auto [x, y] = cellOf(p);
  if (x < 0 || y < 0 || x >= width_ || y >= height_) return nullptr;
  const std::int32_t at = nearest_[index(x, y)];
  return at < 0 ? nullptr : &surfaces_[static_cast<std::size_t>(at)];
}
}  // namespace slamot::scans
