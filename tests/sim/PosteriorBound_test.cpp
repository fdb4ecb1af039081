#include <slamot/math/statistics.h>
#include <slamot/sim/posteriorBound.h>

#include "AcceleratedPoint.h"
#include "worlds.h"

namespace slamot::sim
{
namespace
{
using test::scenario;
using test::shipped;

constexpr const char* kNoTarget = "target_sensor.detection_probability=0";

// A robot by itself that drives straight on from a known start, and sees nothing.
std::vector<std::string> alone(const std::vector<std::string>& more = {})
{
  std::vector<std::string> out = {
      "world.landmarks=0", "robot.following=false", "robot.motion=straight",   "robot.start=given",
      "robot.start_x_m=1", "robot.start_y_m=5",     "robot.start_theta_deg=0", kNoTarget};
  out.insert(out.end(), more.begin(), more.end());
  return out;
}

PosteriorBound bound(const Scenario& s, std::uint64_t seed = 1, int robots = 1)
{
  const auto out = posteriorBound(s, seed, robots);
  EXPECT_TRUE(out.has_value());
  return out.value_or(PosteriorBound{{{}}, {}, {}});
}

TEST(PosteriorBound, OfSpeedAloneIsARandomWalk)
{
  const auto b = bound(scenario(alone({"robot.omega_std_radps=0"})));
  // Variance k (0.4 * 0.025)² after k of 320 steps, the start among them.
  EXPECT_NEAR(b.robots[0].position.bound, 0.01 * std::sqrt(160.0), 1e-12);
  EXPECT_NEAR(b.robots[0].heading.bound, 0, 1e-12);
  EXPECT_FALSE(b.map);
}

TEST(PosteriorBound, OfTurnRateAloneIsThatOfItsIntegrals)
{
  const auto b = bound(scenario(alone({"robot.v_std_mps=0"})), 3);
  const double q = std::pow(0.0872 * 0.025, 2), way = 1.5 * 0.025;
  double heading = 0, place = 0;
  for (int k = 0; k <= 320; ++k)
  {
    heading += k * q / 321;
    // A turn j steps ago, which comes before its move, has moved the place j + 1 steps sideways;
    // the way bends a little.
    for (int j = 0; j < k; ++j) place += q * std::pow(way * (j + 1), 2) / 321;
  }
  EXPECT_NEAR(b.robots[0].heading.bound, std::sqrt(heading), 1e-12);
  EXPECT_NEAR(b.robots[0].position.bound, std::sqrt(place), 2e-3 * std::sqrt(place));
}

TEST(PosteriorBound, OfALandmarkSeenFromOnePlaceIsThatOfTheMean)
{
  const auto b = bound(scenario(
      {"world.landmarks=0", "world.landmark_positions_m=3,8", "robot.following=false",
       "robot.motion=straight", "robot.start=given", "robot.start_x_m=1", "robot.start_y_m=5",
       "robot.speed_mps=0", "robot.v_std_mps=0", "robot.omega_std_radps=0"}));
  const double range2 = 2 * 2 + 3 * 3;
  EXPECT_NEAR(b.map->bound, std::sqrt((0.1 * 0.1 + range2 * 0.008 * 0.008) / 40), 1e-12);
  EXPECT_NEAR(b.robots[0].position.bound, 0, 1e-12);
}

// Landmarks are only known from where the robot started, and so tell nothing of it.
TEST(PosteriorBound, CountsStartsOnce)
{
  const auto exact = bound(scenario({kNoTarget}));
  const auto doubtful = bound(scenario({kNoTarget, "robot.start_std_x_m=0.3"}));
  const auto unknown = bound(scenario({kNoTarget, "robot.start_known=false"}));
  EXPECT_NEAR(doubtful.robots[0].position.bound, std::hypot(exact.robots[0].position.bound, 0.3),
              1e-9);
  EXPECT_DOUBLE_EQ(unknown.robots[0].position.bound, exact.robots[0].position.bound);
}

// Laws, exact for each seed: derivatives are taken at the same truth, and sightings only come.
class MoreInformation : public ::testing::TestWithParam<std::pair<std::string, std::string>>
{
};

TEST_P(MoreInformation, NeverRaisesTheBound)
{
  const auto& [less, more] = GetParam();
  for (std::uint64_t seed = 1; seed <= 5; ++seed)
  {
    const auto a = bound(scenario({less}), seed), b = bound(scenario({more}), seed);
    EXPECT_LE(b.robots[0].position.bound, a.robots[0].position.bound + 1e-12) << seed;
    EXPECT_LE(b.robots[0].heading.bound, a.robots[0].heading.bound + 1e-12) << seed;
    EXPECT_LE(b.targets.at(1).bound, a.targets.at(1).bound + 1e-12) << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(
    PosteriorBound, MoreInformation,
    ::testing::Values(
        std::pair("world.landmarks=5", "world.landmarks=40"),
        std::pair("landmark_sensor.detection_probability=0.5",
                  "landmark_sensor.detection_probability=0.9"),
        std::pair("target_sensor.detection_probability=0.3",
                  "target_sensor.detection_probability=1"),
        std::pair("landmark_sensor.range_max_m=3", "landmark_sensor.range_max_m=6"),
        std::pair("landmark_sensor.bearing_std_rad=0.02", "landmark_sensor.bearing_std_rad=0.005"),
        std::pair("target_sensor.bearing_only=true", "target_sensor.bearing_only=false"),
        std::pair("target.start_std_x_m=0.5", "target.start_std_x_m=0.1")));

TEST(PosteriorBound, IsBlindToClutterAndIdentities)
{
  const auto a = bound(scenario(), 2);
  const auto b =
      bound(scenario({"landmark_sensor.clutter_per_scan=5", "target_sensor.clutter_per_scan=2",
                      "landmark_sensor.identities=false"}),
            2);
  EXPECT_DOUBLE_EQ(a.robots[0].position.bound, b.robots[0].position.bound);
  EXPECT_DOUBLE_EQ(a.targets.at(1).bound, b.targets.at(1).bound);
}

TEST(PosteriorBound, OfATargetCountsFromItsFirstSighting)
{
  const auto known = bound(scenario(), 4);
  const auto unknown = bound(scenario({"target.start_known=false"}), 4);
  EXPECT_GT(unknown.targets.at(1).bound, known.targets.at(1).bound);
  EXPECT_LT(unknown.targets.at(1).bound, 1);
  const auto never =
      bound(scenario({"target.start_known=false", "target_sensor.detection_probability=0"}), 4);
  EXPECT_TRUE(never.targets.empty());
}

TEST(PosteriorBound, OfATeamIsBelowThatOfOneRobot)
{
  const Scenario s = test::team({"world.steps=400"});
  for (std::uint64_t seed = 1; seed <= 3; ++seed)
  {
    const auto one = bound(s, seed, 1), two = bound(s, seed, 2);
    ASSERT_EQ(two.robots.size(), 2u);
    EXPECT_LT(two.robots[0].position.bound, one.robots[0].position.bound);
    EXPECT_LT(two.targets.at(0).bound, one.targets.at(0).bound);
    EXPECT_GT(two.targets.at(0).bound, 0);
  }
}

// Each robot as it would be by itself, where they share nothing.
TEST(PosteriorBound, OfATeamThatSharesNothingIsThatOfEachRobot)
{
  const Scenario s = test::team({"world.steps=200", "target_sensor.detection_probability=0",
                                 "mate_sensor.detection_probability=0", "world.landmarks=0"});
  const auto one = bound(s, 1, 1), two = bound(s, 1, 2);
  EXPECT_NEAR(two.robots[0].position.bound, one.robots[0].position.bound, 1e-12);
  EXPECT_NEAR(two.robots[0].heading.bound, one.robots[0].heading.bound, 1e-12);
}

// What the efficient filter makes of the noises drawn, against what its covariance says: mean
// squares over 100 seeds.
void expectEfficient(const Scenario& s, int robots, int targets)
{
  std::map<std::string, std::pair<double, double>> squares;
  const auto add = [&](const std::string& what, const PosteriorBound::Figure& f)
  {
    squares[what].first += f.efficient * f.efficient;
    squares[what].second += f.bound * f.bound;
  };
  for (std::uint64_t seed = 1; seed <= 100; ++seed)
  {
    const auto b = bound(s, seed, robots);
    add("position", b.robots[0].position);
    add("heading", b.robots[0].heading);
    add("map", *b.map);
    for (const auto& [id, figure] : b.targets) add("target " + std::to_string(id), figure);
  }
  EXPECT_EQ(squares.size(), 3u + static_cast<std::size_t>(targets));
  for (const auto& [what, sum] : squares)
    EXPECT_NEAR(std::sqrt(sum.first / sum.second), 1, 0.15) << what;
}

TEST(PosteriorBound, IsTheMeanSquareOfTheEfficientFilter)
{
  expectEfficient(scenario({"robot.start_std_x_m=0.05", "robot.start_std_theta_rad=0.02"}), 1, 1);
  expectEfficient(scenario({"target.start_known=false", "target_sensor.bearing_only=true"}), 1, 1);
}

TEST(PosteriorBound, IsTheMeanSquareOfTheEfficientFilterOfATeam)
{
  expectEfficient(test::team({"world.steps=60"}), 2, 1);
}

TEST(PosteriorBound, IsTheSameForEqualSeeds)
{
  const Scenario s = shipped("loop");
  EXPECT_EQ(bound(s, 7).robots[0].position.bound, bound(s, 7).robots[0].position.bound);
  EXPECT_NE(bound(s, 7).robots[0].position.bound, bound(s, 8).robots[0].position.bound);
}

// Where 2000 points got to, against the covariance that the linear motion gives.
TEST(AcceleratedPoint, SpreadsAsItsLinearMotionSays)
{
  Motion m;
  m.kind = Motion::Kind::kAccelerated;
  m.speed = 2;
  m.speedBand = 0.5;
  m.cone = 0.4;
  m.jerkNoise = 0.02;
  const Pose2D start(1, 2, 0.7);
  constexpr int kSteps = 60, kPoints = 2000;
  const double dt = 0.1;

  AcceleratedPoint::Linear sum;
  {
    AcceleratedPoint point(m, start);
    math::RandomStream still{99};
    for (int i = 0; i < kSteps; ++i)
    {
      AcceleratedPoint::Linear linear;
      point.move(dt, still, &linear);
      sum.Q = (linear.F * sum.Q * linear.F.transpose() + linear.Q).eval();
    }
  }
  Vector3 mean = Vector3::Zero();
  Matrix3 squares = Matrix3::Zero();
  for (int n = 0; n < kPoints; ++n)
  {
    AcceleratedPoint point(m, start);
    math::RandomStream random{5, static_cast<std::uint64_t>(n)};
    for (int i = 0; i < kSteps; ++i) point.move(dt, random);
    const Pose2D d = math::between(start, point.pose());
    const Vector3 v(d.x, d.y, d.phi);
    mean += v / kPoints;
    squares += v * v.transpose() / kPoints;
  }
  const Matrix3 cov = squares - mean * mean.transpose();
  const Matrix2 R = math::poseRotation(start.phi).topLeftCorner<2, 2>();
  const Matrix2 place = R.transpose() * sum.Q.topLeftCorner<2, 2>() * R;
  // Variances of 2000 draws scatter by 3%.
  EXPECT_NEAR(cov(0, 0) / place(0, 0), 1, 0.15);
  EXPECT_NEAR(cov(1, 1) / place(1, 1), 1, 0.15);
  EXPECT_NEAR(cov(2, 2) / sum.Q(4, 4), 1, 0.15);
  EXPECT_LT(std::abs(cov(0, 1)), 0.15 * std::sqrt(cov(0, 0) * cov(1, 1)));
}

TEST(AcceleratedPoint, MovesAlikeWhetherLinearisedOrNot)
{
  const Scenario s = test::team();
  AcceleratedPoint a(s.targets.at(0).motion, {}), b(s.targets.at(0).motion, {});
  math::RandomStream one{3}, other{3};
  for (int i = 0; i < 50; ++i)
  {
    AcceleratedPoint::Linear linear;
    a.move(0.2, one, &linear);
    b.move(0.2, other);
  }
  EXPECT_EQ(a.pose(), b.pose());
}
}  // namespace
}  // namespace slamot::sim
