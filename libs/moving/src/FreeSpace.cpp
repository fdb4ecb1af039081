#include <slamot/moving/FreeSpace.h>

#include <algorithm>
#include <cmath>

namespace slamot::moving
{
namespace
{
// Log odds: two looks through a cell make it free, one return makes it occupied.
constexpr float kHit = 1.0F, kMiss = -0.7F, kMost = 2.1F, kFreeBelow = -1.3F, kOccupiedAbove = 0.1F;
}  // namespace

FreeSpace::Key FreeSpace::keyOf(int x, int y) const
{
  return (static_cast<Key>(static_cast<std::uint32_t>(x)) << 32U) | static_cast<std::uint32_t>(y);
}

int FreeSpace::indexOf(double along) const
{
  constexpr double kFarthest = 1e9;  // cells
  return static_cast<int>(std::clamp(std::floor(along / options_.cell), -kFarthest, kFarthest));
}

float FreeSpace::oddsAt(int x, int y, double time) const
{
  const auto found = cells_.find(keyOf(x, y));
  if (found == cells_.end() || time - found->second.seen > options_.remember) return 0;
  return found->second.odds;
}

Evidence FreeSpace::at(const Point2D& p, double range, double time) const
{
  const int x = column(p), y = row(p);
  const int reach = static_cast<int>(std::lround(marginAt(range) / options_.cell));
  for (int dx = -reach; dx <= reach; ++dx)
    for (int dy = -reach; dy <= reach; ++dy)
      if (oddsAt(x + dx, y + dy, time) > kOccupiedAbove) return Evidence::kOccupied;
  return oddsAt(x, y, time) < kFreeBelow ? Evidence::kFree : Evidence::kUnknown;
}

bool FreeSpace::isOccupied(const Point2D& p, double time) const
{
  return oddsAt(column(p), row(p), time) > kOccupiedAbove;
}

void FreeSpace::change(int x, int y, bool occupied, double time)
{
  Cell& cell = cells_[keyOf(x, y)];
  if (time - cell.seen > options_.remember) cell = {};
  cell.seen = time;
  if (cell.scan == scan_)
  {
    if (!occupied || cell.hit) return;
  }
  else
    cell.before = cell.odds;
  cell.scan = scan_;
  cell.hit = occupied;
  cell.odds = std::clamp(cell.before + (occupied ? kHit : kMiss), -kMost, kMost);
}

// Samples at half a cell: a corner that is cut is free all the same.
void FreeSpace::passThrough(const Point2D& laser, const Point2D& end, double time)
{
  const double dx = end.x - laser.x, dy = end.y - laser.y, length = std::hypot(dx, dy);
  const double step = 0.5 * options_.cell;
  int lastX = 0, lastY = 0;
  bool any = false;
  for (double along = 0; along < length - marginAt(length); along += step)
  {
    const Point2D at{laser.x + dx * along / length, laser.y + dy * along / length};
    const int x = column(at), y = row(at);
    if (any && x == lastX && y == lastY) continue;
    change(x, y, false, time);
    lastX = x, lastY = y, any = true;
  }
}

void FreeSpace::add(const Point2D& laser, const Point2D& end, bool counts, double time)
{
  passThrough(laser, end, time);
  if (counts) change(column(end), row(end), true, time);
}

void FreeSpace::forget(const Point2D& p)
{
  cells_.erase(keyOf(column(p), row(p)));
}

void FreeSpace::tidy(double time)
{
  constexpr std::uint32_t kEvery = 64;
  if (++scan_ % kEvery != 0) return;
  for (auto it = cells_.begin(); it != cells_.end();)
    it = time - it->second.seen > options_.remember ? cells_.erase(it) : std::next(it);
}
}  // namespace slamot::moving
