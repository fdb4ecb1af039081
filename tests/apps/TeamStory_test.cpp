#include "../../apps/slamot/TeamStory.h"

#include <gtest/gtest.h>

namespace slamot::apps
{
namespace
{
using Outcome = core::Pairing::Outcome;

/// Four rows, one second apart, along a line; landmark 7, first seen in the third, and a target.
SavedRun runFrom(double start, double y, double deviation)
{
  SavedRun run;
  for (int i = 0; i < 4; ++i)
    run.record.rows.push_back({start + i, {{1.0 * i, y, 0}, Matrix3::Identity()}, {}, true});
  run.record.landmarks = {{7, {{5, 5}, deviation * deviation * Matrix2::Identity()}, 2}};
  run.record.pairings = {{start + 2, {false, 0, Outcome::kNew, 7}, 7}};
  eval::TargetTrack target;
  target.id = 1, target.identified = true;
  for (const std::size_t row : {1u, 2u})
    target.rows.push_back({row, {{9, y, 0}, Matrix3::Identity()}, {0, 0}, 0});
  run.record.targets = {target};
  return run;
}

SavedTeam sample()
{
  SavedTeam team;
  team.title = "team of 2";
  team.names = {"a", "b"};
  team.runs = {runFrom(100, 0, 1), runFrom(101.5, 3, 0.5)};
  team.runs[1].evaluation.robot.steps = {{1, {0.3, 0.4, 0}, true, {}, {}}};
  return team;
}

TEST(TeamStory, HasARowForEachInstantOfAnyRobot)
{
  const SavedTeam team = sample();
  const TeamStory story(team);
  EXPECT_DOUBLE_EQ(story.duration(), 4.5);
  EXPECT_EQ(story.rowAt(0), 0u);
  EXPECT_EQ(story.rowAt(1.4), 1u);
  EXPECT_EQ(story.rowAt(1.5), 2u);
  EXPECT_EQ(story.rowAt(99), 7u);
  EXPECT_EQ(momentsOf(story, 1.5).back(), 7u);
}

TEST(TeamStory, ShowsEachRobotWhereItIsThen)
{
  const SavedTeam team = sample();
  const TeamStory story(team);
  const mrpt::SceneData first = story.at(story.rowAt(1)).scene;
  ASSERT_EQ(first.team.size(), 2u) << "each keeps its colour";
  EXPECT_TRUE(first.robot.path.empty());
  EXPECT_DOUBLE_EQ(first.team[0].robot.now->mean.x, 1);
  EXPECT_FALSE(first.team[1].robot.now) << "it has not started";
  EXPECT_EQ(first.team[1].robot.name, "b");
  EXPECT_TRUE(first.team[0].target.now);
  EXPECT_FALSE(first.team[1].target.now);

  const mrpt::SceneData later = story.at(story.rowAt(2.5)).scene;  // at 102.5
  EXPECT_DOUBLE_EQ(later.team[0].robot.now->mean.x, 2);
  EXPECT_DOUBLE_EQ(later.team[1].robot.now->mean.x, 1);
  EXPECT_DOUBLE_EQ(later.team[1].target.now->mean.y, 3);
  EXPECT_EQ(later.team[1].robot.path.at(0).size(), 2u);
  const mrpt::SceneData end = story.at(story.rowAt(99)).scene;
  EXPECT_FALSE(end.team[0].target.now) << "lost";
  EXPECT_EQ(end.team[0].target.path.size(), 1u) << "its path stays";
}

TEST(TeamStory, LandmarksAppearWhenTheFirstRobotHasSeenThem)
{
  const SavedTeam team = sample();
  const TeamStory story(team);
  EXPECT_TRUE(story.at(story.rowAt(1.9)).scene.landmarks.empty());
  ASSERT_EQ(story.at(story.rowAt(2)).scene.landmarks.size(), 1u);
  EXPECT_DOUBLE_EQ(story.at(story.rowAt(2)).scene.landmarks[0].position.cov(0, 0), 1);
  ASSERT_EQ(story.at(story.rowAt(4)).scene.landmarks.size(), 1u) << "one landmark, seen by both";
  EXPECT_DOUBLE_EQ(story.at(story.rowAt(4)).scene.landmarks[0].position.cov(0, 0), 0.25);
  EXPECT_EQ(story.whole().landmarks.size(), 1u);
  EXPECT_EQ(story.whole().team.size(), 2u);
}

TEST(TeamStory, CaptionTellsAllErrors)
{
  SavedTeam team = sample();
  EXPECT_EQ(TeamStory(team).at(1).caption, "t = 1.0 s");
  EXPECT_EQ(TeamStory(team).at(4).caption, "t = 2.5 s   position errors ?, 0.50 m");
  team.runs[0].evaluation.robot.steps = {{2, {1, 0, 0}, true, {}, {}}};
  EXPECT_EQ(TeamStory(team).at(4).caption, "t = 2.5 s   position errors 1.00, 0.50 m");
}
}  // namespace
}  // namespace slamot::apps
