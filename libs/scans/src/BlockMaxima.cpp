#include <slamot/scans/BlockMaxima.h>

#include <algorithm>

namespace slamot::scans
{
namespace
{
using Level = BlockMaxima::Level;

/// Maxima over blocks of twice the size.
Level halved(const Level& fine)
{
  Level out((fine.width + 1) / 2, (fine.height + 1) / 2);
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x)
      out.value[out.index(x, y)] = std::max(
          {fine.value[fine.index(2 * x, 2 * y)], fine.value[fine.index(2 * x + 1, 2 * y)],
           fine.value[fine.index(2 * x, 2 * y + 1)], fine.value[fine.index(2 * x + 1, 2 * y + 1)]});
  return out;
}

/// A block's value then covers the block after it too: wherever in a block a point lies, moving it
/// by up to a block's size is bounded by one look.
void coverNext(Level& level)
{
  std::vector<std::uint8_t>& v = level.value;
  const std::size_t row = level.index(0, 1) - level.index(0, 0);
  for (std::size_t i = 0; i + row + 1 < v.size(); ++i)  // those read are not yet written
    v[i] = std::max({v[i], v[i + 1], v[i + row], v[i + row + 1]});
}

}  // namespace

BlockMaxima::BlockMaxima(Level blocks)
{
  for (std::size_t level = 0; level < levels_.size(); ++level)
  {
    Level coarser = level + 1 < levels_.size() ? halved(blocks) : Level{};
    if (level > 0) coverNext(blocks);
    levels_[level] = std::move(blocks);
    blocks = std::move(coarser);
  }
}
}  // namespace slamot::scans
