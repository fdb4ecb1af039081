#include "worlds.h"

#include <limits>

namespace slamot::sim
{
namespace
{
using test::shipped;
using Landmarks = std::map<int, Point2D>;

Landmarks landmarks(const Scenario& s, std::uint64_t seed)
{
  return World(s, seed).truth().landmarks;
}

// Distance from a landmark to the nearest other one of its cluster.
double toNearest(const Landmarks& all, int id, int clusterSize)
{
  double nearest = std::numeric_limits<double>::infinity();
  const int first = id - id % clusterSize;
  for (int other = first; other < first + clusterSize && all.count(other); ++other)
    if (other != id) nearest = std::min(nearest, (all.at(other) - all.at(id)).norm());
  return nearest;
}

// By the lines that a ray to the right crosses.
bool isInside(const std::vector<Point2D>& loop, const Point2D& p)
{
  bool inside = false;
  for (std::size_t i = 0; i < loop.size(); ++i)
  {
    const Point2D &a = loop[i], &b = loop[(i + 1) % loop.size()];
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y))
      inside = !inside;
  }
  return inside;
}

TEST(Landmarks, AlongThePathFillTheBandOnBothSides)
{
  const Scenario s = shipped("loop", {"world.landmarks=4000"});
  const Motion& path = s.robots[0].motion;
  double depth = 0;
  int inside = 0;
  for (const auto& [id, p] : landmarks(s, 1))
  {
    const double d = path.distanceToPath(p);
    EXPECT_TRUE(d >= 2 && d <= 20) << d;
    EXPECT_TRUE(s.area.contains(p));
    depth += d / 4000;
    inside += isInside(path.waypoints, p);
  }
  // The band would be uniform in depth, with mean 11, but for what the world's sides cut off.
  EXPECT_NEAR(depth, 10.5, 0.5);
  EXPECT_NEAR(inside, 2000, 300);
}

TEST(Landmarks, AlongACircleLieInARing)
{
  const Scenario s = test::scenario(
      {"robot.following=false", "robot.start=path", "world.landmark_placement=along_path",
       "world.landmark_path_min_m=1", "world.landmark_path_max_m=2", "world.landmarks=500"});
  int within = 0;
  for (const auto& [id, p] : landmarks(s, 3))
  {
    const double r = std::hypot(p.x - 5, p.y - 5);  // of a circle of 1.5 m
    EXPECT_TRUE(r <= 0.5 || (r >= 2.5 && r <= 3.5)) << r;
    within += r <= 0.5;
  }
  EXPECT_GT(within, 0);
}

TEST(Landmarks, OfAnOpenPathLieNotBetweenItsEnds)
{
  Motion m;
  m.kind = Motion::Kind::kWaypoints;
  m.waypoints = {{0, 0}, {4, 0}, {4, 3}};
  m.loop = true;
  EXPECT_NEAR(m.distanceToPath({2, 1.5}), 0, 1e-12);  // on the way back
  m.loop = false;
  EXPECT_NEAR(m.distanceToPath({2, 1.5}), 1.5, 1e-12);
  EXPECT_NEAR(m.distanceToPath({-3, -4}), 5, 1e-12);
}

TEST(Landmarks, OfAClusterStandAsFarApartAsIsSaid)
{
  const Scenario s = shipped("loop-hard", {"world.landmarks=253"});
  for (std::uint64_t seed = 1; seed <= 3; ++seed)
  {
    const Landmarks all = landmarks(s, seed);
    ASSERT_EQ(all.size(), 253u);
    for (const auto& [id, p] : all) EXPECT_NEAR(toNearest(all, id, 5), 0.8, 1e-9) << id;
  }
}

TEST(Landmarks, OfDifferentClustersKeepTheirOwnDistance)
{
  const Landmarks all = landmarks(shipped("loop-hard", {"world.landmark_spacing_min_m=3"}), 1);
  for (const auto& [i, p] : all)
    for (const auto& [j, q] : all)
    {
      if (i >= j) continue;
      EXPECT_GE((p - q).norm(), i / 5 == j / 5 ? 0.8 - 1e-9 : 3 - 1e-9);
    }
}

TEST(Landmarks, MoreOfThemLeaveTheFirstWhereTheyAre)
{
  const Landmarks few = landmarks(shipped("loop"), 4), many = landmarks(shipped("loop-dense"), 4);
  for (const auto& [id, p] : few) EXPECT_EQ(p, many.at(id));
  EXPECT_NE(few.at(0), landmarks(shipped("loop"), 5).at(0));
}
}  // namespace
}  // namespace slamot::sim
