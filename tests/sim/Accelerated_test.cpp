// Targets of nearly constant acceleration, and robots that follow them on either side.
#include "worlds.h"

#include <slamot/math/random.h>
#include <slamot/math/statistics.h>

#include <Eigen/LU>

namespace slamot::sim
{
namespace
{
using test::drain;
using test::team;

constexpr auto kAsRead = World::Sightings::kAsRead;

std::vector<Pose2D> targetPath(World& world)
{
  while (world.next())
  {
  }
  std::vector<Pose2D> out;
  for (const auto& row : world.truth().targets.at(0).poses) out.push_back(row.pose);
  return out;
}

double wayLeft(const Pose2D& target, const Pose2D& robot)
{
  return -(robot.x - target.x) * std::sin(target.phi) + (robot.y - target.y) * std::cos(target.phi);
}

TEST(Accelerated, WithoutJerkIsStraightOn)
{
  World world(team({"target_0.jerk_noise_mps3_per_sqrt_hz=0", "target_0.start_theta_deg=30"}), 2);
  const auto path = targetPath(world);
  for (std::size_t i = 0; i < path.size(); ++i)
  {
    EXPECT_NEAR(path[i].x, 30 + 2.5 * 0.2 * double(i) * std::cos(math::kPi / 6), 1e-9);
    EXPECT_NEAR(path[i].y, 150 + 2.5 * 0.2 * double(i) * std::sin(math::kPi / 6), 1e-9);
    EXPECT_NEAR(path[i].phi, math::kPi / 6, 1e-12);
  }
}

TEST(Accelerated, StaysInItsBandAndConeHoweverHardItIsShaken)
{
  for (const std::string jerk : {"0.05", "1"})
    for (std::uint64_t seed = 1; seed <= 3; ++seed)
    {
      World world(team({"target_0.jerk_noise_mps3_per_sqrt_hz=" + jerk, "world.steps=3000"}), seed);
      const auto path = targetPath(world);
      double slowest = 1e9, fastest = 0, furthest = 0;
      for (std::size_t i = 1; i < path.size(); ++i)
      {
        const double dx = path[i].x - path[i - 1].x, dy = path[i].y - path[i - 1].y;
        slowest = std::min(slowest, std::hypot(dx, dy) / 0.2);
        fastest = std::max(fastest, std::hypot(dx, dy) / 0.2);
        furthest = std::max(furthest, std::abs(path[i].phi));
        // Where it heads is where it goes.
        EXPECT_NEAR(math::wrapToPi(std::atan2(dy, dx) - path[i].phi), 0, 0.1);
      }
      EXPECT_LT(fastest, 3.5);
      EXPECT_LT(furthest, math::degToRad(40));
      // A polygon's side is a bit shorter than the arc.
      EXPECT_GT(slowest, 1.49);
      // And it makes use of what it may.
      EXPECT_GT(fastest - slowest, 0.8);
      EXPECT_GT(furthest, 0.3);
    }
}

TEST(Accelerated, IsMovedByWhiteJerkOfTheScenariosStrength)
{
  // In the middle of the band: the third difference of three times integrated white noise has the
  // variance 11/20 q² dt⁵; every third one is independent.
  double squares = 0;
  int n = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed)
  {
    World world(team({"target_0.jerk_noise_mps3_per_sqrt_hz=0.02", "world.steps=25",
                      "target_0.speed_band_mps=2.4", "target_0.direction_cone_deg=80"}),
                seed);
    const auto p = targetPath(world);
    const double sigma = 0.02 * std::sqrt(11.0 / 20 * std::pow(0.2, 5));
    for (std::size_t i = 3; i < p.size(); i += 3)
    {
      const double dx = p[i].x - 3 * p[i - 1].x + 3 * p[i - 2].x - p[i - 3].x;
      const double dy = p[i].y - 3 * p[i - 1].y + 3 * p[i - 2].y - p[i - 3].y;
      squares += (dx * dx + dy * dy) / (sigma * sigma);
      n += 2;
    }
  }
  EXPECT_GT(n, 3000);
  EXPECT_GT(squares, 0.97 * math::chiSquareQuantile(1e-4, n));
  EXPECT_LT(squares, 1.03 * math::chiSquareQuantile(1 - 1e-4, n));
}

// One axis of a constant-acceleration Kalman filter: place, speed, acceleration.
struct Axis
{
  Vector3 x;
  Matrix3 P;

  void predict(double q, double dt)
  {
    Matrix3 F;
    F << 1, dt, dt * dt / 2, 0, 1, dt, 0, 0, 1;
    Matrix3 Q;
    const double d2 = dt * dt, d3 = d2 * dt;
    Q << d3 * d2 / 20, d2 * d2 / 8, d3 / 6, d2 * d2 / 8, d3 / 3, d2 / 2, d3 / 6, d2 / 2, dt;
    x = F * x;
    P = (F * P * F.transpose() + q * q * Q).eval();
  }
  void correct(double z, double std)
  {
    const Vector3 K = P.col(0) / (P(0, 0) + std * std);
    x += K * (z - x[0]);
    P -= (K * P.row(0)).eval();
  }
  // Of place and speed.
  [[nodiscard]] double nees(double place, double speed) const
  {
    const Vector2 e(x[0] - place, x[1] - speed);
    const Matrix2 cov = P.topLeftCorner<2, 2>();
    return math::mahalanobisSquared(e, cov);
  }
};

TEST(Accelerated, IsWhatAConstantAccelerationFilterOfThatJerkExpects)
{
  double sum = 0;
  int n = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed)
  {
    World world(team(), seed);
    const auto p = targetPath(world);
    math::RandomStream noise{seed, 99};
    Axis x{{30, 2.5, 0}, Vector3(0.01, 0.01, 1e-4).asDiagonal()}, y = x;
    y.x = {150, 0, 0};
    for (std::size_t i = 1; i + 1 < p.size(); ++i)
    {
      x.predict(0.05, 0.2), y.predict(0.05, 0.2);
      x.correct(p[i].x + 0.2 * noise.normal(), 0.2), y.correct(p[i].y + 0.2 * noise.normal(), 0.2);
      if (i < 50) continue;
      sum += x.nees(p[i].x, (p[i + 1].x - p[i - 1].x) / 0.4);
      sum += y.nees(p[i].y, (p[i + 1].y - p[i - 1].y) / 0.4);
      n += 4;
    }
  }
  // A little below one: near the edges of band and cone the jerk is weaker.
  EXPECT_GT(sum / n, 0.85);
  EXPECT_LT(sum / n, 1.05);
}

TEST(Accelerated, ItsStartIsToldWithVelocityAndAcceleration)
{
  using Start = core::ObjectStart;
  double squares = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed)
  {
    World world(team({"target_0.start_theta_deg=90"}), seed, kAsRead, 1);
    const Start& s = world.starts().targets.at(0);
    EXPECT_EQ(s.getStd(Start::kVx), 0.1);
    EXPECT_EQ(s.getStd(Start::kAy), 0.05);
    squares += std::pow(s.get(Start::kVx) / 0.1, 2) + std::pow((s.get(Start::kVy) - 2.5) / 0.1, 2) +
               std::pow(s.get(Start::kAx) / 0.05, 2) + std::pow(s.get(Start::kAy) / 0.05, 2);
  }
  EXPECT_GT(squares, math::chiSquareQuantile(1e-4, 800));
  EXPECT_LT(squares, math::chiSquareQuantile(1 - 1e-4, 800));
}

TEST(FollowSide, KeepsRobotsOnEitherSideForTenMinutes)
{
  for (std::uint64_t seed = 1; seed <= 3; ++seed)
  {
    const Scenario s = team({"world.steps=3000", "world.scan_every=3000", "robot_0.v_std_mps=0.3",
                             "robot_0.omega_std_radps=0.1"});
    World left(s, seed), right(s, seed, kAsRead, 1);
    for (World* world : {&left, &right})
    {
      const double side = world == &left ? 1 : -1;
      while (const auto step = world->next())
      {
        const Pose2D target = world->truth().targets.at(0).poses.back().pose;
        const Pose2D robot = world->truth().robot.poses.back().pose;
        EXPECT_NEAR(side * wayLeft(target, robot), 20, 4) << "seed " << seed << ' ' << step->time;
        EXPECT_LT(std::hypot(target.x - robot.x, target.y - robot.y), 30);
        // A car: no faster than it may, never backwards, never sideways.
        const Pose2D& m = step->odometry->mean;
        const double ahead = m.x * std::cos(m.phi) + m.y * std::sin(m.phi);
        EXPECT_GE(ahead, 0);
        EXPECT_LE(ahead, 5 * 0.2 + 1e-9);
        EXPECT_NEAR(m.y * std::cos(m.phi) - m.x * std::sin(m.phi), 0, 1e-12);
        EXPECT_LE(std::abs(m.phi), 0.5 * 0.2 + 1e-9);
      }
    }
  }
}

TEST(FollowSide, FindsItsSideFromTheOtherOne)
{
  World world(team({"robot_0.start_y_m=110", "world.scan_every=500"}), 4);
  drain(world);
  const Pose2D target = world.truth().targets.at(0).poses.back().pose;
  EXPECT_NEAR(wayLeft(target, world.truth().robot.poses.back().pose), 20, 3);
}

// The shipped world: crossed once, never left, the target and the mate in view.
TEST(FollowSide, TeamCrossesItsWorld)
{
  for (const char* name : {"/sim.team-300m.ini", "/sim.ekf-slamot-ci.ini"})
  {
    core::Config config = core::Config::load(std::string(SLAMOT_CONFIG_INI) + name);
    config.set("world.scan_every=10000");
    const Scenario s = Scenario::from(config);
    for (std::uint64_t seed = 1; seed <= 10; ++seed)
    {
      World a(s, seed), b(s, seed, kAsRead, 1);
      double lastX = 0;
      while (a.next() && b.next())
      {
        const Pose2D robotA = a.truth().robot.poses.back().pose;
        const Pose2D robotB = b.truth().robot.poses.back().pose;
        const Pose2D target = a.truth().targets.at(0).poses.back().pose;
        EXPECT_GT(target.x, lastX);
        lastX = target.x;
        EXPECT_TRUE(s.area.contains({target.x, target.y}, 10)) << name << " seed " << seed;
        EXPECT_LT(std::hypot(robotA.x - robotB.x, robotA.y - robotB.y), 45);
        EXPECT_LT(std::hypot(robotA.x - target.x, robotA.y - target.y), 30);
        EXPECT_GT(wayLeft(target, robotA), 10);
        EXPECT_LT(wayLeft(target, robotB), -10);
      }
      EXPECT_GT(lastX, 0.8 * s.area.width) << name << " seed " << seed;
    }
  }
}
}  // namespace
}  // namespace slamot::sim
