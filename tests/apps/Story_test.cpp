#include "../../apps/slamot/Story.h"

#include <gtest/gtest.h>

namespace slamot::apps
{
namespace
{
using Outcome = core::Pairing::Outcome;

std::shared_ptr<const core::LaserScan> wallAhead(float range)
{
  auto scan = std::make_shared<core::LaserScan>();
  scan->rangeMax = 10;
  scan->ranges = {range};
  return scan;
}

/// Five rows, one second apart; two landmarks, seen from the second and from the fourth row on.
SavedRun sample()
{
  SavedRun run;
  run.title = "a";
  for (int i = 0; i < 5; ++i)
    run.record.rows.push_back({100.0 + i, {{1.0 * i, 0, 0}, Matrix3::Identity()}, {}, true});
  for (const int id : {7, 9})
    run.record.landmarks.push_back({id, {{1.0 * id, 1}, Matrix2::Identity()}, 2});
  run.record.pairings = {{101, {false, 0, Outcome::kNew, 7}, 7},
                         {103, {false, 0, Outcome::kKnown, 7}, 7},
                         {103, {false, 1, Outcome::kNew, 9}, 9},
                         {103, {false, 2, Outcome::kRejected, 9}, 9}};
  run.record.lasers = {{1, wallAhead(3)}, {3, wallAhead(1)}};
  for (const double t : {100.0, 102.0}) run.truth.robot.poses.push_back({t, {t - 100, 0.25, 0}});
  run.evaluation.robot.steps = {{1, {0, 0.25, 0}, true, {}, {}}};
  eval::TargetTrack target;
  target.id = 1;
  for (const std::size_t row : {2u, 3u}) target.rows.push_back({row, {}, {0, 0}, 0});
  run.record.targets = {target};
  run.particles = {{{4, 0, 0}, 1}};
  return run;
}

TEST(Story, FindsTheRowOfATime)
{
  const SavedRun run = sample();
  const RobotStory story(run);
  EXPECT_DOUBLE_EQ(story.duration(), 4);
  EXPECT_EQ(story.rowAt(0), 0u);
  EXPECT_EQ(story.rowAt(1.99), 1u);
  EXPECT_EQ(story.rowAt(2), 2u);
  EXPECT_EQ(story.rowAt(99), 4u);
}

TEST(Story, MomentsGoFromTheStartToTheEnd)
{
  const SavedRun run = sample();
  const RobotStory story(run);
  EXPECT_EQ(momentsOf(story, 0.5).size(), 9u);
  EXPECT_EQ(momentsOf(story, 0.5).back(), 4u);
  EXPECT_EQ(momentsOf(story, 3), (std::vector<std::size_t>{0, 3, 4})) << "the end is not left out";
  EXPECT_EQ(momentsOf(story, 100), (std::vector<std::size_t>{0, 4}));
}

TEST(Story, AMomentKnowsNothingOfWhatComes)
{
  const SavedRun run = sample();
  const RobotStory story(run);
  const mrpt::SceneData scene = story.at(1).scene;
  EXPECT_EQ(scene.robot.path.at(0).size(), 2u);
  EXPECT_DOUBLE_EQ(scene.robot.now->mean.x, 1);
  EXPECT_EQ(scene.robot.truth.at(0).size(), 1u);
  ASSERT_EQ(scene.landmarks.size(), 1u);
  EXPECT_EQ(scene.landmarks[0].id, 7);
  EXPECT_EQ(scene.laserPoints.size(), 1u);
  ASSERT_EQ(scene.targets.size(), 1u) << "it keeps its colour";
  EXPECT_TRUE(scene.targets[0].path.empty());
  EXPECT_FALSE(scene.targets[0].now);
  EXPECT_TRUE(scene.particles.empty());
}

TEST(Story, AMapThatWasNumberedAnewStandsFromTheStart)
{
  SavedRun run = sample();
  for (eval::PairingRow& p : run.record.pairings) p.pairing.id = 1;
  EXPECT_EQ(RobotStory(run).at(0).scene.landmarks.size(), 2u);
}

TEST(Story, TargetsComeAndGo)
{
  const SavedRun run = sample();
  const RobotStory story(run);
  EXPECT_TRUE(story.at(3).scene.targets.at(0).now);
  EXPECT_FALSE(story.at(4).scene.targets.at(0).now);
}

TEST(Story, ShowsWhatIsSeenNow)
{
  const SavedRun run = sample();
  const RobotStory story(run);
  const mrpt::SceneData scene = story.at(3).scene;
  ASSERT_EQ(scene.sightings.size(), 2u) << "not the rejected one";
  EXPECT_DOUBLE_EQ(scene.sightings[0][0].x, 3) << "from the robot";
  ASSERT_EQ(scene.scanPoints.size(), 1u);
  EXPECT_DOUBLE_EQ(scene.scanPoints[0].x, 4);
  EXPECT_TRUE(story.at(0).scene.sightings.empty());
  EXPECT_TRUE(story.at(0).scene.scanPoints.empty());
  EXPECT_TRUE(story.at(4).scene.scanPoints.empty()) << "a scan of a second ago is not of now";
}

TEST(Story, TheEndHasParticles)
{
  const SavedRun run = sample();
  const RobotStory story(run);
  EXPECT_EQ(story.at(4).scene.particles.size(), 1u);
  EXPECT_EQ(story.at(4).scene.landmarks.size(), 2u);
}

TEST(Story, CaptionTellsTimeAndErrorWhereItIsKnown)
{
  const SavedRun run = sample();
  const RobotStory story(run);
  EXPECT_EQ(story.at(1).caption, "t = 1.0 s   position error 0.25 m");
  EXPECT_EQ(story.at(4).caption, "t = 4.0 s   no truth for this moment");
  SavedRun untold = sample();
  untold.evaluation.robot.steps.clear();
  EXPECT_EQ(RobotStory(untold).at(4).caption, "t = 4.0 s");
}

TEST(Story, AWallIsDrawnOnceHoweverOftenItIsSeen)
{
  SavedRun run = sample();
  run.record.lasers = {{1, wallAhead(3)}, {1, wallAhead(3)}, {3, wallAhead(1)}};
  const RobotStory story(run);
  EXPECT_EQ(story.whole().laserPoints.size(), 1u);
  EXPECT_EQ(story.at(1).scene.scanPoints.size(), 2u) << "the scan itself is whole";
}
}  // namespace
}  // namespace slamot::apps
