#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace slamot::scans
{
/// A grid's values, and the largest ones of blocks of 1, 2, 4 ... cells, so that a search need not
/// look at each.  Olson, "Real-time correlative scan matching", 2009.
class BlockMaxima
{
 public:
  static constexpr int kLevels = 6;  ///< blocks of up to 2^(kLevels - 1) cells a side

  /// Values of blocks, with a margin of zeros around them.
  struct Level
  {
    Level() = default;
    /// All zero.
    Level(int w, int h)
        : width(w),
          height(h),
          value(static_cast<std::size_t>(w + 2) * static_cast<std::size_t>(h + 2))
    {
    }
    /// Of -1 .. width, -1 .. height.
    [[nodiscard]] std::size_t index(int x, int y) const
    {
      return static_cast<std::size_t>(y + 1) * static_cast<std::size_t>(width + 2) +
             static_cast<std::size_t>(x + 1);
    }
    int width = 0;                    ///< in blocks
    int height = 0;                   ///< in blocks
    std::vector<std::uint8_t> value;  ///< by index()
  };

  BlockMaxima() = default;
  /// From the cells' own values, as level 0.
  explicit BlockMaxima(Level blocks);

  /// The largest value of the cells x .. x + 2^level - 1, y likewise, or a bit more; 0 outside.
  [[nodiscard]] int bound(int level, int x, int y) const
  {
    const Level& l = levels_[static_cast<std::size_t>(level)];
    const int i = x >> level, j = y >> level;
    if (i < -1 || j < -1 || i >= l.width || j >= l.height) return 0;
    return l.value[l.index(i, j)];
  }

 private:
  std::array<Level, kLevels> levels_;
};
}  // namespace slamot::scans
