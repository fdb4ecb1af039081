#include "worlds.h"

namespace slamot::sim
{
namespace
{
using test::drain;
using test::scenario;

// Commanded speed and turn rate of a step of 0.025 s.
double speedOf(const core::Step& s)
{
  const Pose2D& m = s.odometry->mean;
  return std::hypot(m.x, m.y) / 0.025;
}
double turnRateOf(const core::Step& s)
{
  return s.odometry->mean.phi / 0.025;
}

TEST(Following, StartsFourMetresAwayFacingTheTarget)
{
  for (std::uint64_t seed = 1; seed <= 50; ++seed)
  {
    World world(scenario(), seed);
    const Pose2D robot = world.truth().robot.poses[0].pose;
    const Pose2D target = world.truth().targets.at(1).poses[0].pose;
    const auto z = models::RangeBearing::predict(robot, {target.x, target.y});
    EXPECT_NEAR(z[0], 4, 1e-9);
    EXPECT_NEAR(z[1], 0, 1e-9);
    EXPECT_NEAR(std::hypot(target.x - 5, target.y - 5), 3, 1e-9);
    EXPECT_TRUE(Area{}.contains({robot.x, robot.y}));
    EXPECT_EQ(world.starts().robotPose().mean, robot);
  }
}

TEST(Following, ObeysThePagesLaw)
{
  World world(scenario(), 6);
  for (int i = 0; i < 320; ++i)
  {
    const Pose2D robot = world.truth().robot.poses.back().pose;
    const Pose2D target = world.truth().targets.at(1).poses.back().pose;
    const auto z = models::RangeBearing::predict(robot, {target.x, target.y});
    const auto step = world.next();
    EXPECT_NEAR(speedOf(*step), std::min(std::max(2 * (z[0] - 1), 0.0), 2.4), 1e-9);
    EXPECT_NEAR(turnRateOf(*step), std::min(std::max(4 * z[1], -3.0), 3.0), 1e-9);
  }
}

TEST(Following, StandsStillWhileItsTargetIsGone)
{
  World world(scenario({"target.present_s=0,2,4,8"}), 6);
  for (const auto& step : drain(world))
    EXPECT_EQ(speedOf(step) == 0, step.time > 2.01 && step.time < 4.01) << step.time;
}

TEST(Following, SwitchedOffTheRobotDrivesItsOwnCircle)
{
  World world(scenario({"robot.following=false", "robot.start=path", "robot.v_std_mps=0",
                        "robot.omega_std_radps=0"}),
              6);
  for (const auto& step : drain(world))
  {
    EXPECT_NEAR(speedOf(step), 1.5, 1e-9);
    EXPECT_NEAR(turnRateOf(step), 1, 1e-9);
  }
  // A polygon of 0.0375 m sides, turned before each side: its centre is off by half a side.
  for (const auto& row : world.truth().robot.poses)
    EXPECT_NEAR(std::hypot(row.pose.x - 5, row.pose.y - 5), 1.5, 0.045);
}

TEST(Waypoints, AreVisitedInTurnAndTheLastIsTheEnd)
{
  World world(scenario({"robot.following=false", "robot.motion=waypoints", "robot.start=path",
                        "robot.waypoints_m=1,1,9,1,9,9,1,9", "robot.waypoints_loop=false",
                        "robot.speed_mps=2", "world.steps=800"}),
              6);
  const Pose2D start = world.truth().robot.poses[0].pose;
  EXPECT_EQ(start, (Pose2D{1, 1, 0}));
  const auto steps = drain(world);
  EXPECT_EQ(speedOf(steps.back()), 0);
  std::size_t next = 0;
  const std::vector<Point2D> points = {{1, 1}, {9, 1}, {9, 9}, {1, 9}};
  for (const auto& row : world.truth().robot.poses)
    if (next < points.size() &&
        std::hypot(row.pose.x - points[next].x, row.pose.y - points[next].y) < 0.5)
      ++next;
  EXPECT_EQ(next, points.size());
}

TEST(Manoeuvre, ChangesItsTurnAtRandomTimesAndStaysInTheWorld)
{
  World world(scenario({"robot.following=false", "robot.motion=manoeuvre", "robot.start=given",
                        "robot.start_x_m=50", "robot.start_y_m=50", "world.width_m=100",
                        "world.height_m=100", "robot.turn_rate_radps=0.7", "robot.speed_mps=2",
                        "world.steps=12000", "robot.border_m=10"}),
              6);
  double lastChange = 0, lastTurn = 0;
  int changes = 0, left = 0;
  for (const auto& step : drain(world))
  {
    EXPECT_NEAR(std::abs(turnRateOf(step)), 0.7, 1e-9);
    left += turnRateOf(step) > 0;
    if (lastTurn != 0 && turnRateOf(step) * lastTurn < 0)
    {
      // The step ends 0.025 s after the change; turning home may come sooner.
      const Pose2D p = world.truth().robot.at(step.time - 0.025)->pose;
      if (Area{100, 100}.contains({p.x, p.y}, 15))
      {
        EXPECT_LE(step.time - lastChange, 3.06);
        ++changes;
      }
      lastChange = step.time;
    }
    lastTurn = turnRateOf(step);
  }
  EXPECT_GT(changes, 50);
  EXPECT_GT(left, 3000);
  EXPECT_LT(left, 9000);
  for (const auto& row : world.truth().robot.poses)
    EXPECT_TRUE((Area{100, 100}.contains({row.pose.x, row.pose.y})));
}
}  // namespace
}  // namespace slamot::sim
