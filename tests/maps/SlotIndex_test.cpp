#include <gtest/gtest.h>
#include <slamot/maps/SlotIndex.h>
#include <slamot/math/random.h>

#include <algorithm>
#include <map>

namespace slamot::maps
{
namespace
{
using math::RandomStream;

SlotExtent drawExtent(RandomStream& random, double world)
{
  SlotExtent e;
  const double x = random.uniform(-world, world), y = random.uniform(-world, world);
  // From a point to wider than the cells that one slot may take.
  const double width = std::pow(10, random.uniform(-3, 2)),
               std = std::pow(10, random.uniform(-3, 1));
  for (int i = 0; i < 3; ++i)
    e.include(x + width * random.normal(), y + width * random.normal(), std * std);
  return e;
}

Box drawBox(RandomStream& random, double world)
{
  Box b;
  b.include(random.uniform(-world, world), random.uniform(-world, world));
  return b.grown(std::pow(10, random.uniform(-2, 3)));
}

std::vector<std::uint32_t> found(const SlotIndex& index, const Box& box, double sigmas)
{
  std::vector<std::uint32_t> out{77};  // must not matter
  index.query(box, sigmas, out);
  return out;
}
}  // namespace

TEST(SlotIndex, EqualsALookAtEverySlot)
{
  for (std::uint64_t seed = 1; seed <= 40; ++seed)
  {
    SCOPED_TRACE(seed);
    RandomStream random{seed};
    const double world = std::pow(10, random.uniform(0, 4));
    SlotIndex index(random.uniform(0.5, 10));
    std::map<std::uint32_t, SlotExtent> placed;
    for (int i = 0; i < 300; ++i)
    {
      const double u = random.uniform();
      if (u < 0.4 || placed.empty())
      {
        const std::uint32_t slot = index.reserve();
        ASSERT_FALSE(placed.count(slot));
        index.place(slot, placed[slot] = drawExtent(random, world));
        continue;
      }
      auto it = placed.begin();
      std::advance(it, static_cast<std::ptrdiff_t>(random.uniform() * double(placed.size())));
      if (u < 0.6)
        index.place(it->first, it->second = drawExtent(random, world));
      else if (u < 0.7)
      {
        index.release(it->first);
        placed.erase(it);
      }
      else
      {
        const Box box = drawBox(random, world);
        const double sigmas = random.uniform(0, 5);
        std::vector<std::uint32_t> expected;
        for (const auto& [slot, e] : placed)
          if (e.means.overlaps(box.grown(sigmas * std::sqrt(e.largestVar))))
            expected.push_back(slot);
        ASSERT_EQ(found(index, box, sigmas), expected);
      }
    }
  }
}

// What the filter relies on: a landmark within so many of its own deviations of the box is found.
TEST(SlotIndex, NeverMissesALandmarkInReach)
{
  RandomStream random{1};
  SlotIndex index;
  std::vector<std::array<double, 3>> landmarks;  // x, y, deviation: many to a slot
  for (int slot = 0; slot < 100; ++slot)
  {
    SlotExtent e;
    const double x = random.uniform(-50, 50), y = random.uniform(-50, 50);
    for (int i = 0; i < 5; ++i)
    {
      landmarks.push_back({x + random.normal(), y + random.normal(), random.uniform(0, 2)});
      const auto& l = landmarks.back();
      e.include(l[0], l[1], l[2] * l[2]);
    }
    index.place(index.reserve(), e);
  }
  for (int i = 0; i < 300; ++i)
  {
    const Box box = drawBox(random, 50);
    const auto slots = found(index, box, 3);
    for (std::size_t k = 0; k < landmarks.size(); ++k)
    {
      const auto& l = landmarks[k];
      const double dx = std::max({box.xMin - l[0], 0.0, l[0] - box.xMax});
      const double dy = std::max({box.yMin - l[1], 0.0, l[1] - box.yMax});
      if (std::hypot(dx, dy) > 3 * l[2]) continue;
      EXPECT_TRUE(
          std::binary_search(slots.begin(), slots.end(), static_cast<std::uint32_t>(k / 5)));
    }
  }
}

TEST(SlotIndex, NumbersSlotsInOrderOfCreation)
{
  SlotIndex index;
  for (std::uint32_t i = 0; i < 3; ++i) EXPECT_EQ(index.serial(index.reserve()), i);
}

TEST(SlotIndex, GivesNumbersOfSlotsNeverPlacedBack)
{
  SlotIndex index;
  const std::uint32_t a = index.reserve(), b = index.reserve(), c = index.reserve();
  index.place(b, {});
  index.release(c);
  EXPECT_EQ(index.serial(index.reserve()), 2u);
  index.release(a);  // not the last: a gap stays
  EXPECT_EQ(index.serial(index.reserve()), 3u);
}

TEST(SlotIndex, NeverUsesANumberTwiceOnceItsSlotWasPlaced)
{
  SlotIndex index;
  const std::uint32_t slot = index.reserve();
  index.place(slot, {});
  index.release(slot);
  EXPECT_EQ(index.serial(index.reserve()), 1u);
}

TEST(SlotIndex, ReleasesSlotsThatNoMapHolds)
{
  SlotIndex index;
  SlotExtent e;
  e.include(1, 1, 0.1);
  for (int i = 0; i < 4; ++i) index.place(index.reserve(), e);
  const std::uint32_t reserved = index.reserve();
  index.releaseUnoccupied({true, false, true});
  EXPECT_EQ(found(index, e.means, 0), (std::vector<std::uint32_t>{0, 2}));
  EXPECT_EQ(index.serial(reserved), 4u);  // not placed yet, so not looked at
  EXPECT_EQ(index.extent(2).largestVar, 0.1);
  // Free slots are used again before new ones.
  index.reserve();
  index.reserve();
  EXPECT_EQ(index.capacity(), 5u);
}

TEST(Box, OfNothingIsEmptyAndOverlapsNothing)
{
  Box all;
  all.include(-1e6, -1e6);
  all.include(1e6, 1e6);
  EXPECT_TRUE(Box{}.empty());
  EXPECT_FALSE(Box{}.overlaps(all));
  Box b = all;
  b.include(Box{});
  EXPECT_EQ(b.xMin, all.xMin);
  EXPECT_EQ(b.yMax, all.yMax);
}
}  // namespace slamot::maps
