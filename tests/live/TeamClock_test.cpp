#include <gtest/gtest.h>
#include <slamot/live/TeamClock.h>

#include <array>
#include <random>

namespace slamot::live
{
namespace
{
Beacon beaconOf(const TeamClock& clock, double wall, double speed = 1)
{
  return {0, 1, speed, clock.at(wall)};
}
}  // namespace

TEST(TeamClock, RunsWithTheWallFromItsZero)
{
  const TeamClock clock({100, 2, {}}, 1000);
  EXPECT_EQ(clock.at(1000), 100);
  EXPECT_EQ(clock.at(1003), 106);
  EXPECT_EQ(clock.wallAt(106), 1003);
  const TeamClock given({100, 2, 900}, 1000);
  EXPECT_EQ(given.at(1000), 300);
}

TEST(TeamClock, FollowsOneThatIsAheadAndNeverGoesBack)
{
  TeamClock late({0, 2, {}}, 1010);
  const TeamClock early({0, 2, {}}, 1000);
  EXPECT_EQ(late.hear(beaconOf(early, 1010, 2), 1010), 20);
  EXPECT_EQ(late.at(1015), early.at(1015));
  TeamClock other = early;
  EXPECT_EQ(other.hear({1, 1, 2, 3.0}, 1010), 0);
  EXPECT_EQ(other.at(1010), 20);
}

TEST(TeamClock, DoesNotFollowWithAGivenStartAnotherSpeedOrFromFarAhead)
{
  TeamClock given({0, 1, 1000}, 1000), clock({0, 1, {}}, 1000);
  EXPECT_EQ(given.hear({1, 1, 1, 50.0}, 1000), 0);
  EXPECT_EQ(clock.hear({1, 1, 2, 50.0}, 1000), 0);
  EXPECT_EQ(clock.hear({1, 1, 1, {}}, 1000), 0);
  EXPECT_EQ(clock.hear({1, 1, 1, 1.2e9}, 1000), 0);
  EXPECT_FALSE(clock.canFollow({1, 1, 1, 1.2e9}, 1000));
  EXPECT_TRUE(clock.canFollow({1, 1, 1, 50.0}, 1000));
}

// Whatever is lost, and in what order they come: the one that is ahead wins in the end.
TEST(TeamClock, AllAgreeOnceAllHaveHeardEachOther)
{
  std::mt19937 random(3);
  for (int trial = 0; trial < 100; ++trial)
  {
    double wall = 1000;
    std::vector<TeamClock> clocks;
    for (int r = 0; r < 4; ++r)
      clocks.emplace_back(TeamClock::Options{static_cast<double>(random() % 50), 1, {}}, wall++);
    double ahead = 0;
    for (const TeamClock& clock : clocks) ahead = std::max(ahead, clock.at(wall));
    for (int i = 0; i < 200; ++i)
      clocks[random() % 4].hear(beaconOf(clocks[random() % 4], wall), wall);
    for (const TeamClock& clock : clocks) EXPECT_DOUBLE_EQ(clock.at(wall), ahead) << trial;
  }
}
}  // namespace slamot::live
