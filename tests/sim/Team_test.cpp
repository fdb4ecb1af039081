// Several robots in one world.
#include "worlds.h"

#include <algorithm>
#include <fstream>
#include <sstream>

namespace slamot::sim
{
namespace
{
using test::drain;
using test::team;

constexpr auto kAsRead = World::Sightings::kAsRead;

const std::vector<std::string> kExactMates = {
    "mate_sensor.range_std_m=1e-12", "mate_sensor.bearing_std_rad=1e-12",
    "mate_sensor.clutter_per_scan=0", "mate_sensor.detection_probability=1",
    "mate_sensor.identities=true"};

std::vector<core::Blob> labelled(const core::Step& step, const std::string& label)
{
  std::vector<core::Blob> out;
  for (const core::Blob& b : step.blobs->blobs)
    if (b.label == label) out.push_back(b);
  return out;
}

// Experiment 1 with as many copies of its robot as asked for.
Scenario experiment1Team(int robots)
{
  std::ifstream file(SLAMOT_CONFIG_INI "/sim.experiment1.ini");
  std::stringstream all;
  all << file.rdbuf();
  std::string text = all.str();
  const std::size_t begin = text.find("\n[robot]"), end = text.find("\n[target]");
  const std::string keys = text.substr(begin + 8, end - begin - 8);
  text.erase(begin, end - begin);
  for (int i = 0; i < robots; ++i) text += "\n[robot_" + std::to_string(i) + "]" + keys;
  core::Config config = core::Config::parse(text, "team");
  return Scenario::from(config);
}

TEST(Team, WorldsOfItsRobotsAreOneWorld)
{
  const Scenario s = team();
  World a(s, 3), b(s, 3, kAsRead, 1);
  EXPECT_EQ(a.truth().landmarks, b.truth().landmarks);
  while (true)
  {
    const auto p = a.next(), q = b.next();
    ASSERT_EQ(p.has_value(), q.has_value());
    if (!p) break;
    EXPECT_EQ(p->time, q->time);
  }
  const auto &targetA = a.truth().targets.at(0).poses, &targetB = b.truth().targets.at(0).poses;
  ASSERT_EQ(targetA.size(), targetB.size());
  for (std::size_t i = 0; i < targetA.size(); ++i)
  {
    EXPECT_EQ(targetA[i].pose, targetB[i].pose);
    EXPECT_NE(a.truth().robot.poses[i].pose, b.truth().robot.poses[i].pose);
  }
}

TEST(Team, ItsFirstRobotIsTheRobotAlone)
{
  World alone(test::scenario(), 7), first(experiment1Team(3), 7);
  const auto a = drain(alone), b = drain(first);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) test::expectSame(a[i], b[i]);
  EXPECT_EQ(alone.starts().toIni(), first.starts().toIni());
}

TEST(Team, EveryRobotDrawsItsOwnNoiseAndStarts)
{
  const Scenario s = experiment1Team(3);
  std::vector<Pose2D> ends;
  std::vector<double> ranges, told;
  for (int robot = 0; robot < 3; ++robot)
  {
    World world(s, 7, kAsRead, robot);
    told.push_back(*world.starts().targets.at(1).value[core::ObjectStart::kX]);
    const auto steps = drain(world);
    ends.push_back(world.truth().robot.poses.back().pose);
    ranges.push_back(steps.at(7).landmarks->sightings.at(0).range);
  }
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < i; ++j)
    {
      EXPECT_NE(ends[i], ends[j]);
      EXPECT_NE(ranges[i], ranges[j]);
      EXPECT_NE(told[i], told[j]);
    }
}

TEST(Team, MatesAreSeenWhereTheyAreWithTheirIndex)
{
  const Scenario s = team(kExactMates);
  World a(s, 5), b(s, 5, kAsRead, 1);
  for (int i = 0; i < 400; ++i)
  {
    const auto p = a.next(), q = b.next();
    const Pose2D poseA = a.truth().robot.poses.back().pose;
    const Pose2D poseB = b.truth().robot.poses.back().pose;
    const auto seenByA = labelled(*p, "robot"), seenByB = labelled(*q, "robot");
    ASSERT_EQ(seenByA.size(), 1u);
    ASSERT_EQ(seenByB.size(), 1u);
    EXPECT_EQ(seenByA[0].id, 1);
    EXPECT_EQ(seenByB[0].id, 0);
    const auto z = models::RangeBearing::predict(poseA, {poseB.x, poseB.y});
    EXPECT_NEAR(*seenByA[0].range, z[0], 1e-10);
    EXPECT_NEAR(math::wrapToPi(seenByA[0].bearing - z[1]), 0, 1e-10);
    const auto w = models::RangeBearing::predict(poseB, {poseA.x, poseA.y});
    EXPECT_NEAR(*seenByB[0].range, w[0], 1e-10);
    EXPECT_NEAR(math::wrapToPi(seenByB[0].bearing - w[1]), 0, 1e-10);
  }
}

TEST(Team, SeeingMatesLeavesAllElseAsItWas)
{
  core::Config config = test::team300();
  config.erase("mate_sensor");
  World without(Scenario::from(config), 5, kAsRead, 1), with(team(), 5, kAsRead, 1);
  while (const auto a = without.next())
  {
    const auto b = with.next();
    core::Step rest = *b;
    rest.blobs->blobs = labelled(*b, "target");
    // Of the mates, too, noise may put some out of view.
    rest.dropped = a->dropped;
    test::expectSame(*a, rest);
    EXPECT_TRUE(std::is_sorted(b->blobs->blobs.begin(), b->blobs->blobs.end(),
                               [](const auto& x, const auto& y) { return x.bearing < y.bearing; }));
  }
}

TEST(Team, OneScanHoldsTheViewOfBothSensors)
{
  World world(team({"mate_sensor.range_min_m=1", "target_sensor.range_min_m=2",
                    "target_sensor.bearing_max_deg=90", "mate_sensor.bearing_min_deg=-45",
                    "mate_sensor.bearing_max_deg=30", "target_sensor.range_max_m=70"}),
              5);
  const auto step = world.next();
  EXPECT_EQ(step->blobs->fov.rangeMin, 1);
  EXPECT_EQ(step->blobs->fov.rangeMax, 70);
  EXPECT_EQ(step->blobs->fov.bearingMin, -math::kPi);
  EXPECT_EQ(step->blobs->fov.bearingMax, math::kPi / 2);
}

TEST(Team, MatesOutOfViewAreNotSeen)
{
  std::vector<std::string> changes = kExactMates;
  changes.push_back("mate_sensor.range_max_m=20");
  World world(team(changes), 5);
  for (const auto& step : drain(world)) EXPECT_TRUE(labelled(step, "robot").empty()) << step.time;
}

TEST(Team, MatesAreLostAmongClutterOfTheScenariosRate)
{
  std::vector<double> ranges;
  double blobs = 0;
  int scans = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed)
  {
    World world(team(), seed);
    for (const auto& step : drain(world))
    {
      ++scans;
      for (const core::Blob& b : labelled(step, "robot"))
      {
        ++blobs;
        EXPECT_EQ(b.id, core::kNoId);
        EXPECT_EQ(b.rangeStd, 0.2);
      }
      for (const core::Blob& b : labelled(step, "target")) EXPECT_EQ(b.id, 0);
    }
  }
  // A mate in view with 0.9 and two false blobs; within 4 deviations.
  EXPECT_NEAR(blobs, scans * 2.9, 4 * std::sqrt(scans * (0.9 * 0.1 + 2)));
}

TEST(Team, HasNoRobotBeyondItsLast)
{
  EXPECT_THROW(World(team(), 1, kAsRead, 2), core::Error);
  EXPECT_THROW(World(team(), 1, kAsRead, -1), core::Error);
}
}  // namespace
}  // namespace slamot::sim
