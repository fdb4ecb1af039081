#include <slamot/perception/LaserClusters.h>

#include "castScans.h"

#include <gtest/gtest.h>

namespace slamot::perception
{
namespace
{
using namespace test;

TEST(ClustersOf, PartsThingsAndTellsWhoseEndsAreTheirOwn)
{
  // A post before a wall, and one that hides part of another.
  const World world{{{{4, 1}, 0.1}, {{3, -1}, 0.1}, {{6, -1.8}, 0.3}}, {{{8, -1}, {8, 6}}}};
  const auto clusters = clustersOf(scanOf(world, {}, 1), {});
  ASSERT_EQ(clusters.size(), 5u);  // from the right: near post, far post, wall, post, wall
  EXPECT_FALSE(clusters[1].freeRight);
  EXPECT_TRUE(clusters[1].freeLeft);
  for (const std::size_t post : {0u, 3u})
  {
    EXPECT_TRUE(clusters[post].freeRight);
    EXPECT_TRUE(clusters[post].freeLeft);
    EXPECT_LT(clusters[post].width(), 0.3);
  }
  EXPECT_FALSE(clusters[2].freeLeft);
  EXPECT_FALSE(clusters[4].freeRight);
}

TEST(ClustersOf, AWallIsOneHoweverFlatTheBeamsMeetIt)
{
  const World corridor{{}, {{{-1, 1}, {4.5, 1}}}};
  EXPECT_EQ(clustersOf(scanOf(corridor, {}, 2), {}).size(), 1u);
}

TEST(ClustersOf, AScanAllRoundIsClosed)
{
  Laser laser;
  laser.pose = {0, 0, math::kPi};
  laser.angleMin = -math::kPi;
  laser.beams = 720;
  const World world{{{{5, 0}, 0.4}}, {}};  // astride the first beam and the last
  const auto clusters = clustersOf(scanOf(world, laser, 3), {});
  ASSERT_EQ(clusters.size(), 1u);
  EXPECT_TRUE(clusters[0].freeLeft && clusters[0].freeRight);
  EXPECT_NEAR(clusters[0].width(), 0.8, 0.1);
  laser.beams = 700;  // not all round: the end is the scan's, not the thing's
  laser.pose.phi = math::kPi - 0.02;
  for (const Cluster& c : clustersOf(scanOf(world, laser, 3), {}))
    EXPECT_FALSE(c.freeLeft && c.freeRight);
}

TEST(ClustersOf, ScansFromLeftToRightAreTheSame)
{
  const World world{{{{4, 1}, 0.1}, {{3, -1}, 0.1}}, {{{8, -1}, {8, 6}}}};
  core::LaserScan scan = scanOf(world, {}, 4), turned = scan;
  std::reverse(turned.ranges.begin(), turned.ranges.end());
  turned.angleMin = scan.angleMin + scan.angleStep * 360;
  turned.angleStep = -scan.angleStep;
  auto a = clustersOf(scan, {}), b = clustersOf(turned, {});
  std::reverse(b.begin(), b.end());
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    EXPECT_EQ(a[i].freeLeft, b[i].freeLeft);
    EXPECT_NEAR(a[i].points.front().at.x, b[i].points.front().at.x, 1e-6);
    EXPECT_NEAR(a[i].points.front().angle, b[i].points.front().angle, 1e-9);
  }
}

TEST(ClustersOf, ScansOfNothing)
{
  core::LaserScan scan;
  EXPECT_TRUE(clustersOf(scan, {}).empty());
  scan.ranges = {1, 1};
  EXPECT_TRUE(clustersOf(scan, {}).empty());  // no step between its beams
  scan.angleStep = 0.01;
  scan.rangeMax = 10;
  scan.ranges = {std::numeric_limits<float>::infinity(), -1, 0, 10, 11,
                 std::numeric_limits<float>::quiet_NaN()};
  EXPECT_TRUE(clustersOf(scan, {}).empty());
}
}  // namespace
}  // namespace slamot::perception
