#include <slamot/moving/FreeSpace.h>

#include <gtest/gtest.h>

using namespace slamot;
using namespace slamot::moving;

namespace
{
/// A laser at the origin that looks along x at something 3 m off, `scans` times a second apart.
FreeSpace lookedAlong(int scans, double end = 3.05)
{
  FreeSpace space{FreeSpace::Options{}};
  for (int i = 0; i < scans; ++i)
  {
    space.tidy(i);
    space.add({0, 0.05}, {end, 0.05}, true, i);
  }
  return space;
}
}  // namespace

TEST(FreeSpace, IsUnknownUntilLookedThroughTwice)
{
  EXPECT_EQ(lookedAlong(0).at({1.05, 0.05}, 1, 0), Evidence::kUnknown);
  EXPECT_EQ(lookedAlong(1).at({1.05, 0.05}, 1, 1), Evidence::kUnknown);
  EXPECT_EQ(lookedAlong(2).at({1.05, 0.05}, 1, 2), Evidence::kFree);
  EXPECT_EQ(lookedAlong(2).at({1.05, 1.05}, 1, 2), Evidence::kUnknown);
}

TEST(FreeSpace, IsOccupiedWhereAndNextToWhereBeamsEnd)
{
  const FreeSpace space = lookedAlong(2);
  EXPECT_EQ(space.at({3.05, 0.05}, 3, 2), Evidence::kOccupied);
  EXPECT_EQ(space.at({3.15, 0.05}, 3, 2), Evidence::kOccupied);
  EXPECT_TRUE(space.isOccupied({3.05, 0.05}, 2));
  EXPECT_FALSE(space.isOccupied({3.15, 0.05}, 2));
}

TEST(FreeSpace, WhatMovesLeavesNoTrace)
{
  FreeSpace space{FreeSpace::Options{}};
  for (int i = 0; i < 3; ++i)
  {
    space.tidy(i);
    space.add({0, 0.05}, {3.05, 0.05}, false, i);
  }
  EXPECT_EQ(space.at({3.05, 0.05}, 3, 2), Evidence::kUnknown);
}

TEST(FreeSpace, WhatStoodIsFreeOnceLookedThroughOften)
{
  FreeSpace space = lookedAlong(10);
  int scans = 0;
  for (; space.at({3.05, 0.05}, 3, 10 + scans) != Evidence::kFree; ++scans)
  {
    ASSERT_LT(scans, 10);
    space.tidy(10 + scans);
    space.add({0, 0.05}, {6.05, 0.05}, true, 10 + scans);
  }
  EXPECT_GE(scans, 3);
}

TEST(FreeSpace, ForgetsWhatIsNotSeen)
{
  const FreeSpace space = lookedAlong(5);
  EXPECT_EQ(space.at({3.05, 0.05}, 3, 4 + 14), Evidence::kOccupied);
  EXPECT_EQ(space.at({3.05, 0.05}, 3, 4 + 16), Evidence::kUnknown);
}

TEST(FreeSpace, NegativeCoordinatesHaveCellsOfTheirOwn)
{
  FreeSpace space{FreeSpace::Options{}};
  space.add({0, 0}, {-2.05, -0.05}, true, 0);
  EXPECT_TRUE(space.isOccupied({-2.05, -0.05}, 0));
  EXPECT_FALSE(space.isOccupied({-1.95, -0.05}, 0));
  EXPECT_FALSE(space.isOccupied({-2.05, 0.05}, 0));
  space.forget({-2.05, -0.05});
  EXPECT_FALSE(space.isOccupied({-2.05, -0.05}, 0));
}

TEST(FreeSpace, IsCountedFromItsOriginHoweverFarThatIs)
{
  const Point2D far{4.5e9, -3e9};
  FreeSpace space(FreeSpace::Options{}, far);
  space.add(far, {far.x + 3.05, far.y + 0.05}, true, 0);
  EXPECT_TRUE(space.isOccupied({far.x + 3.05, far.y + 0.05}, 0));
  EXPECT_FALSE(space.isOccupied({far.x + 2.85, far.y + 0.05}, 0));
  EXPECT_FALSE(space.isOccupied({1e300, -1e300}, 0));  // no cell there, and no overflow
}

// The looks of one scan count once, also at the limit of what is counted.
TEST(FreeSpace, AReturnWinsOverABeamOfTheSameScan)
{
  const auto looksUntilOccupied = [](bool passedFirst)
  {
    FreeSpace space = lookedAlong(20, 6.05);
    int scans = 0;
    while (!space.isOccupied({3.05, 0.05}, 20 + scans) && scans < 20)
    {
      space.tidy(20 + scans);
      if (passedFirst) space.add({0, 0.05}, {6.05, 0.05}, true, 20 + scans);
      space.add({0, 0.05}, {3.05, 0.05}, true, 20 + scans);
      ++scans;
    }
    return scans;
  };
  EXPECT_EQ(looksUntilOccupied(true), looksUntilOccupied(false));
}
