#include <slamot/maps/SlotIndex.h>

#include <algorithm>
#include <cmath>

namespace slamot::maps
{
namespace
{
constexpr double kMostCells = 64;  // of one slot; of a query: beyond that a scan of all is cheaper

std::uint64_t cellKey(std::int64_t ix, std::int64_t iy)
{
  return (static_cast<std::uint64_t>(ix) << 32) ^ static_cast<std::uint32_t>(iy);
}

void eraseValue(std::vector<std::uint32_t>& list, std::uint32_t value)
{
  const auto it = std::find(list.begin(), list.end(), value);
  if (it == list.end()) return;
  *it = list.back();
  list.pop_back();
}

double cellCount(const Box& c)
{
  return (c.xMax - c.xMin + 1) * (c.yMax - c.yMin + 1);
}
}  // namespace

Box SlotIndex::cellsOf(const Box& box) const
{
  return {std::floor(box.xMin / cellSize_), std::floor(box.yMin / cellSize_),
          std::floor(box.xMax / cellSize_), std::floor(box.yMax / cellSize_)};
}

template <class F>
void SlotIndex::forCells(const Box& cells, F&& f) const
{
  for (auto ix = static_cast<std::int64_t>(cells.xMin); ix <= static_cast<std::int64_t>(cells.xMax);
       ++ix)
    for (auto iy = static_cast<std::int64_t>(cells.yMin);
         iy <= static_cast<std::int64_t>(cells.yMax); ++iy)
      f(cellKey(ix, iy));
}

std::uint32_t SlotIndex::reserve()
{
  std::uint32_t slot;
  if (free_.empty())
  {
    slot = static_cast<std::uint32_t>(slots_.size());
    slots_.emplace_back();
  }
  else
  {
    slot = free_.back();
    free_.pop_back();
  }
  slots_[slot] = Slot{};
  slots_[slot].used = true;
  slots_[slot].serial = nextSerial_++;
  return slot;
}

void SlotIndex::release(std::uint32_t slot)
{
  // The number goes back if nobody has seen it, so that numbers follow creation without gaps.
  if (!slots_[slot].placed && slots_[slot].serial + 1 == nextSerial_) --nextSerial_;
  if (slots_[slot].placed) remove(slot);
  slots_[slot] = Slot{};
  free_.push_back(slot);
}

void SlotIndex::place(std::uint32_t slot, const SlotExtent& extent)
{
  Slot& s = slots_[slot];
  const Box cells = cellsOf(extent.means);
  largestStd_ = std::max(largestStd_, std::sqrt(extent.largestVar));
  s.extent = extent;
  if (s.placed && cells.xMin == s.cells.xMin && cells.xMax == s.cells.xMax &&
      cells.yMin == s.cells.yMin && cells.yMax == s.cells.yMax)
    return;
  if (s.placed) remove(slot);
  s.cells = cells;
  s.placed = true;
  insert(slot);
}

void SlotIndex::insert(std::uint32_t slot)
{
  const Box& cells = slots_[slot].cells;
  if (!(cellCount(cells) <= kMostCells))
    large_.push_back(slot);
  else
    forCells(cells, [&](std::uint64_t key) { grid_[key].push_back(slot); });
}

void SlotIndex::remove(std::uint32_t slot)
{
  const Box& cells = slots_[slot].cells;
  if (!(cellCount(cells) <= kMostCells))
    eraseValue(large_, slot);
  else
    forCells(cells, [&](std::uint64_t key) { eraseValue(grid_.at(key), slot); });
}

void SlotIndex::query(const Box& box, double sigmas, std::vector<std::uint32_t>& out) const
{
  out.clear();
  const auto consider = [&](std::uint32_t slot)
  {
    const Slot& s = slots_[slot];
    if (s.extent.means.overlaps(box.grown(sigmas * std::sqrt(s.extent.largestVar))))
      out.push_back(slot);
  };
  const Box cells = cellsOf(box.grown(sigmas * largestStd_));
  if (cellCount(cells) <= std::max<double>(kMostCells, static_cast<double>(slots_.size())))
  {
    forCells(cells,
             [&](std::uint64_t key)
             {
               if (const auto it = grid_.find(key); it != grid_.end())
                 for (const std::uint32_t slot : it->second) consider(slot);
             });
    for (const std::uint32_t slot : large_) consider(slot);
  }
  else
    for (std::uint32_t slot = 0; slot < slots_.size(); ++slot)
      if (slots_[slot].placed) consider(slot);
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
}

void SlotIndex::releaseUnoccupied(const std::vector<bool>& occupied)
{
  for (std::uint32_t slot = 0; slot < slots_.size(); ++slot)
    if (slots_[slot].placed && (slot >= occupied.size() || !occupied[slot])) release(slot);
}
}  // namespace slamot::maps
