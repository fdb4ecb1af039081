#pragma once

#include <slamot/math/geometry.h>

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace slamot::maps
{
/// An axis-aligned box in the plane [m].
struct Box
{
  double xMin = 1e300;   ///< [m]; as made, the box is empty
  double yMin = 1e300;   ///< [m]
  double xMax = -1e300;  ///< [m]
  double yMax = -1e300;  ///< [m]

  /// Grows the box until the point is in it.
  void include(double x, double y)
  {
    xMin = x < xMin ? x : xMin;
    xMax = x > xMax ? x : xMax;
    yMin = y < yMin ? y : yMin;
    yMax = y > yMax ? y : yMax;
  }
  /// Grows the box until the other one is in it.
  void include(const Box& b)
  {
    if (b.empty()) return;
    include(b.xMin, b.yMin);
    include(b.xMax, b.yMax);
  }
  /// Whether nothing was included yet.
  [[nodiscard]] bool empty() const { return xMin > xMax; }
  /// Larger by so much [m] on each side.
  [[nodiscard]] Box grown(double by) const { return {xMin - by, yMin - by, xMax + by, yMax + by}; }
  /// Whether the two have a point in common; borders count.
  [[nodiscard]] bool overlaps(const Box& b) const
  {
    return xMin <= b.xMax && b.xMin <= xMax && yMin <= b.yMax && b.yMin <= yMax;
  }
};

/// Where the landmark of one slot is, over all particles that hold it.
struct SlotExtent
{
  Box means;              ///< of its means
  double largestVar = 0;  ///< largest eigenvalue of any of its covariances [m²]

  /// One more particle's landmark: its mean, and the larger eigenvalue of its covariance [m²].
  void include(double x, double y, double variance)
  {
    means.include(x, y);
    largestVar = variance > largestVar ? variance : largestVar;
  }
};

/// The slots that the particles' maps share, with a grid over the places where their landmarks are.
/// One index serves all particles: a slot stands for one sighting that at least one particle took
/// for a new landmark, and particles that inherit it hold it near the same place.
class SlotIndex
{
 public:
  /// \param cellSize edge of the grid's cells [m], about a sensor's reach.
  explicit SlotIndex(double cellSize = 5.0) : cellSize_(cellSize) {}

  /// A slot that is free; its landmark's number in order of creation comes with serial().
  std::uint32_t reserve();
  /// Gives a slot back, for reserve() to give out again.
  void release(std::uint32_t slot);
  /// Sets where a reserved slot's landmark is.
  void place(std::uint32_t slot, const SlotExtent& extent);

  /// Slots whose landmark may have a mean inside the box, or one within `sigmas` of its own
  /// standard deviations from it; in rising order.
  void query(const Box& box, double sigmas, std::vector<std::uint32_t>& out) const;

  /// Releases the placed slots for which occupied[slot] is false.
  void releaseUnoccupied(const std::vector<bool>& occupied);

  /// The number, in order of creation, of the landmark that a slot stands for.
  [[nodiscard]] std::uint32_t serial(std::uint32_t slot) const { return slots_[slot].serial; }
  /// Where a slot's landmark is, as place() was told.
  [[nodiscard]] const SlotExtent& extent(std::uint32_t slot) const { return slots_[slot].extent; }
  /// One more than the highest slot ever reserved.
  [[nodiscard]] std::size_t capacity() const { return slots_.size(); }

 private:
  struct Slot
  {
    SlotExtent extent;
    std::uint32_t serial = 0;
    bool used = false, placed = false;
    Box cells;  // of the grid, inclusive; in cell coordinates
  };
  [[nodiscard]] Box cellsOf(const Box& box) const;
  template <class F>
  void forCells(const Box& cells, F&& f) const;
  void remove(std::uint32_t slot);
  void insert(std::uint32_t slot);

  double cellSize_;
  std::vector<Slot> slots_;
  std::vector<std::uint32_t> free_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> grid_;
  std::vector<std::uint32_t> large_;  // slots spread over too many cells: looked at by each query
  double largestStd_ = 0;             // of any slot ever placed [m]: bounds the reach of a query
  std::uint32_t nextSerial_ = 0;
};
}  // namespace slamot::maps
