#include "../../apps/slamot/sceneOf.h"

#include <gtest/gtest.h>

namespace slamot::apps
{
namespace
{
/// A robot at three places, a target that is lost and found again, a map turned by a quarter.
struct Sample
{
  eval::Record record;
  eval::Truth truth;
  eval::Evaluation evaluation;

  Sample()
  {
    for (int i = 0; i < 3; ++i)
      record.rows.push_back({0.1 * i, {{1.0 * i, 0, 0}, Matrix3::Identity()}, {}, false});
    eval::TargetTrack target;
    target.id = 4, target.label = "target", target.identified = true;
    for (const std::size_t row : {0u, 2u})
    {
      eval::TargetRow t;
      t.row = row, t.pose.mean = {5, 1.0 * static_cast<double>(row), 0};
      target.rows.push_back(t);
    }
    record.targets = {target};
    for (const double time : {0.0, 0.1, 9.0}) truth.robot.poses.push_back({time, {time, 0, 0}});
    truth.landmarks[7] = {3, 0};
    evaluation.truthFromMap = {0, 0, math::kPi / 2};
  }
  [[nodiscard]] results::RunView view() const { return {record, truth, evaluation}; }
};

TEST(SceneOf, PathsBreakWhereNothingIsKnown)
{
  const Sample sample;
  const mrpt::SceneData scene = sceneOf("a", sample.view(), {});
  ASSERT_EQ(scene.targets.size(), 1u);
  EXPECT_EQ(scene.robot.path.size(), 1u);
  EXPECT_EQ(scene.robot.path[0].size(), 3u);
  EXPECT_EQ(scene.targets[0].path.size(), 2u);
  EXPECT_EQ(scene.robot.truth.size(), 2u);
  EXPECT_TRUE(scene.targets[0].now) << "it is followed in the last row";
}

TEST(SceneOf, TruthIsMovedIntoTheMapsFrame)
{
  const Sample sample;
  const mrpt::SceneData scene = sceneOf("a", sample.view(), {});
  EXPECT_NEAR(scene.trueLandmarks.at(0).x, 0, 1e-12);
  EXPECT_NEAR(scene.trueLandmarks.at(0).y, -3, 1e-12);
  EXPECT_NEAR(scene.robot.truth[1][0].y, -9, 1e-12);
}

TEST(SceneOf, LaserPointsAreSeenFromTheRobot)
{
  Sample sample;
  auto scan = std::make_shared<core::LaserScan>();
  scan->pose_robot_sensor = {0.5, 0, 0};
  scan->angleMin = math::kPi / 2, scan->angleStep = 0.1, scan->rangeMax = 10;
  scan->ranges = {2.0f, 0.0f, 11.0f};  // the last two returned nothing
  sample.record.lasers = {{1, scan}};
  const auto points = sceneOf("a", sample.view(), {}).laserPoints;
  ASSERT_EQ(points.size(), 1u);
  EXPECT_NEAR(points[0].x, 1.5, 1e-9);
  EXPECT_NEAR(points[0].y, 2, 1e-9);
}
}  // namespace
}  // namespace slamot::apps
