#include "worlds.h"

#include <slamot/math/statistics.h>

namespace slamot::sim
{
namespace
{
using test::shipped;

// Speed and wheel's angle that make an increment of the front axle's middle.
Vector2 controls(const Pose2D& increment, double dt)
{
  return {std::hypot(increment.x, increment.y) / dt, std::atan2(increment.y, increment.x)};
}

TEST(Steering, TurnsByTheSineOfTheWheelsAngle)
{
  World world(shipped("loop", {"robot.drive=steering", "robot.wheel_base_m=2.5"}), 1);
  while (const auto step = world.next())
  {
    const Vector2 told = controls(step->odometry->mean, 0.025);
    EXPECT_NEAR(told[0], 3, 1e-9);
    EXPECT_NEAR(step->odometry->mean.phi, 3 * 0.025 * std::sin(told[1]) / 2.5, 1e-12);
  }
}

TEST(Steering, WheelKeepsItsLimits)
{
  World world(shipped("loop", {"robot.drive=steering", "robot.steer_max_deg=8",
                               "robot.steer_rate_max_deg_per_s=10"}),
              1);
  double before = 0, largest = 0, fastest = 0;
  while (const auto step = world.next())
  {
    const double angle = controls(step->odometry->mean, 0.025)[1];
    largest = std::max(largest, std::abs(angle));
    fastest = std::max(fastest, std::abs(angle - before) / 0.025);
    before = angle;
  }
  EXPECT_NEAR(math::radToDeg(largest), 8, 1e-6);
  EXPECT_NEAR(math::radToDeg(fastest), 10, 1e-6);
}

TEST(Steering, NoiseIsWhatTheScenarioAndOdometrysCovarianceSay)
{
  World world(shipped("loop", {"robot.drive=steering"}), 11);
  double v2 = 0, angle2 = 0, nees = 0;
  int n = 0;
  while (const auto step = world.next())
  {
    const auto& poses = world.truth().robot.poses;
    const Pose2D done = math::between(poses[poses.size() - 2].pose, poses.back().pose);
    const Vector2 noise = controls(done, 0.025) - controls(step->odometry->mean, 0.025);
    v2 += noise[0] * noise[0] / (0.3 * 0.3);
    angle2 += std::pow(noise[1] / math::degToRad(3), 2);
    // Two noises move three coordinates: what the covariance has no room for is left out.
    const Vector2 e(done.x - step->odometry->mean.x, done.y - step->odometry->mean.y);
    const Matrix2 P = step->odometry->cov.topLeftCorner<2, 2>();
    nees += math::mahalanobisSquared(e, P);
    ++n;
  }
  for (const double sum : {v2, angle2})
  {
    EXPECT_GT(sum, math::chiSquareQuantile(5e-5, n));
    EXPECT_LT(sum, math::chiSquareQuantile(1 - 5e-5, n));
  }
  // To first order in the noise only.
  EXPECT_NEAR(nees / n, 2, 0.1);
}

TEST(Steering, CovarianceIsThatOfSmallNoises)
{
  const Scenario s = shipped("loop", {"robot.drive=steering"});
  Motion m = s.robots[0].motion;
  World world(s, 1);
  for (int i = 0; i < 400; ++i) (void)world.next();
  const auto step = world.next();
  const Vector2 told = controls(step->odometry->mean, 0.025);
  const auto moved = [&](double v, double angle)
  {
    const double way = v * 0.025;
    return Vector3(way * std::cos(angle), way * std::sin(angle),
                   way * std::sin(angle) / m.wheelBase);
  };
  const double h = 1e-6;
  Eigen::Matrix<double, 3, 2> G;
  G.col(0) = (moved(told[0] + h, told[1]) - moved(told[0] - h, told[1])) / (2 * h) * m.vStd;
  G.col(1) = (moved(told[0], told[1] + h) - moved(told[0], told[1] - h)) / (2 * h) * m.steerStd;
  EXPECT_LT((step->odometry->cov - G * G.transpose()).cwiseAbs().maxCoeff(), 1e-12);
}
}  // namespace
}  // namespace slamot::sim
