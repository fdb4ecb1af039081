#include "worlds.h"

#include <slamot/math/statistics.h>
#include <slamot/sim/posteriorBound.h>

#include "LawScore.h"

namespace slamot::sim
{
namespace
{
using models::NoiseLaw;
using models::RangeBearing;
using test::drain;
using test::shipped;
using Tail = NoiseLaw::Tail;

/// Sightings by their squared size in ordinary deviations, in a world of one kind of noise.
std::vector<double> squaredSizes(const Scenario& s, std::uint64_t seed)
{
  World world(s, seed);
  std::vector<double> out;
  while (const auto step = world.next())
    for (const core::Blob& b : step->blobs->blobs)
    {
      const Pose2D target = world.truth().targets.at(1).poses.back().pose;
      const auto z =
          RangeBearing::predict(world.truth().robot.poses.back().pose, {target.x, target.y});
      out.push_back(std::pow((*b.range - z[0]) / b.rangeStd, 2) +
                    std::pow(math::wrapToPi(b.bearing - z[1]) / b.bearingStd, 2));
    }
  return out;
}

double shareBeyond(const std::vector<double>& squares, double q)
{
  return static_cast<double>(
             std::count_if(squares.begin(), squares.end(), [&](double s) { return s > q; })) /
         static_cast<double>(squares.size());
}

// Of all coordinates alike: Student's tail with 2 degrees beyond a radius r is 1 / (1 + r² / 2).
TEST(Glint, IsAsOftenAndAsFarAsTheLawSays)
{
  const Scenario s = shipped(
      "glint-polar", {"world.steps=20000", "target.speed_mps=0", "target.acceleration_std_mps2=0"});
  const auto squares = squaredSizes(s, 1);
  EXPECT_NEAR(static_cast<double>(squares.size()), 20000, 60);  // a few ranges fall below zero
  for (const double sigmas : {5.0, 10.0, 20.0})
  {
    const double q = sigmas * sigmas;
    const double expected = 0.3 / (1 + q / 9 / 2) + 0.7 * std::exp(-0.5 * q);
    EXPECT_NEAR(shareBeyond(squares, q), expected, 4 * std::sqrt(expected / 20000)) << sigmas;
  }
}

TEST(Glint, LeavesOrdinaryErrorsAsTheyAreWithoutIt)
{
  const auto plain = squaredSizes(shipped("glint-polar", {"target_sensor.glint_probability=0"}), 3);
  const auto some = squaredSizes(shipped("glint-polar"), 3);
  ASSERT_EQ(plain.size(), some.size());
  int same = 0, larger = 0;
  for (std::size_t i = 0; i < plain.size(); ++i) ++(some[i] == plain[i] ? same : larger);
  EXPECT_NEAR(larger, 30, 4 * std::sqrt(100 * 0.3 * 0.7));
  EXPECT_EQ(same + larger, 100);
}

TEST(Glint, OfMoreProbabilityIsThatOfLessAndSomeMore)
{
  const auto few = squaredSizes(shipped("glint-polar", {"target_sensor.glint_probability=0.1"}), 3);
  const auto none = squaredSizes(shipped("glint-polar", {"target_sensor.glint_probability=0"}), 3);
  const auto many =
      squaredSizes(shipped("glint-polar", {"target_sensor.glint_probability=0.5"}), 3);
  for (std::size_t i = 0; i < none.size(); ++i)
  {
    const bool glints = few[i] != none[i];
    EXPECT_TRUE(!glints || many[i] == few[i]) << i;
  }
}

// Not told which: what a log says of the errors is that of ordinary ones.
TEST(Glint, IsNotTold)
{
  World world(shipped("glint-polar"), 2);
  for (const core::Step& step : drain(world))
    for (const core::Blob& b : step.blobs->blobs)
    {
      EXPECT_EQ(b.rangeStd, 10);
      EXPECT_EQ(b.bearingStd, 0.01);
    }
}

TEST(Glint, OfLandmarksAndMatesHasTheirOwnKeys)
{
  const std::vector<std::string> keys = {"landmark_sensor.glint_probability=0.2",
                                         "mate_sensor.glint_probability=0.1",
                                         "mate_sensor.glint_law=laplace"};
  const Scenario s = test::team(keys);
  EXPECT_EQ(s.landmarkSensor.glint->settings().probability, 0.2);
  EXPECT_EQ(s.mateSensor->glint->settings().tail, Tail::kLaplace);
  EXPECT_FALSE(s.targetSensor->glint);
}

// A range at or below zero is dropped and counted, as that of any noise.
TEST(Glint, OutOfViewIsDropped)
{
  const Scenario s = test::scenario(
      {"target_sensor.glint_probability=1", "target_sensor.glint_scale=100", "world.steps=800"});
  World world(s, 1);
  int dropped = 0, seen = 0;
  while (const auto step = world.next())
  {
    dropped += step->dropped;
    if (!step->blobs) continue;
    for (const core::Blob& b : step->blobs->blobs)
    {
      EXPECT_GT(*b.range, 0);
      ++seen;
    }
  }
  EXPECT_GT(dropped, 20);
  EXPECT_GT(seen, 10);
}

// A place with equal errors along both axes of the map, turned back from range and bearing.
TEST(PositionSensor, TellsAPlaceWithEqualErrors)
{
  World world(shipped("glint-position",
                      {"world.steps=4000", "target.speed_mps=0", "target.acceleration_std_mps2=0",
                       "target_sensor.glint_probability=0", "target.start_x_m=40"}),
              5);
  double xx = 0, yy = 0, xy = 0, x = 0, y = 0;
  int n = 0;
  while (const auto step = world.next())
  {
    const core::Blob& b = step->blobs->blobs.at(0);
    const Point2D at = RangeBearing::invert({0, 0, math::kPi / 4}, {*b.range, b.bearing});
    const double dx = at.x - 40, dy = at.y - 500;
    x += dx, y += dy, xx += dx * dx, yy += dy * dy, xy += dx * dy, ++n;
    EXPECT_EQ(b.rangeStd, 10);
    EXPECT_DOUBLE_EQ(b.bearingStd * *b.range, 10);
  }
  ASSERT_EQ(n, 4000);
  for (const double squares : {xx, yy})
  {
    EXPECT_GT(squares / 100, math::chiSquareQuantile(1e-4, n));
    EXPECT_LT(squares / 100, math::chiSquareQuantile(1 - 1e-4, n));
  }
  EXPECT_LT(std::abs(xy / n), 4 * 100 / std::sqrt(n));
  EXPECT_LT(std::abs(x / n), 4 * 10 / std::sqrt(n));
  EXPECT_LT(std::abs(y / n), 4 * 10 / std::sqrt(n));
}

TEST(WhiteAcceleration, IsConstantOverAStepAndWhite)
{
  World world(shipped("glint-position", {"world.steps=3000"}), 4);
  const auto& poses = world.truth().targets.at(1).poses;
  Vector2 last = *poses.back().velocity;
  EXPECT_NEAR(last.norm(), 10, 1e-12);
  double squares = 0, product = 0, before = 0;
  while (world.next())
  {
    const auto &a = poses[poses.size() - 2], &b = poses.back();
    const Vector2 acceleration = *b.velocity - last;  // over 1 s
    EXPECT_NEAR(b.pose.x - a.pose.x, last.x() + 0.5 * acceleration.x(), 1e-9);
    EXPECT_NEAR(b.pose.y - a.pose.y, last.y() + 0.5 * acceleration.y(), 1e-9);
    EXPECT_NEAR(b.pose.phi, std::atan2(b.velocity->y(), b.velocity->x()), 1e-12);
    squares += acceleration.squaredNorm() / 0.01;
    product += acceleration.x() * before / 0.01;
    before = acceleration.x();
    last = *b.velocity;
  }
  EXPECT_GT(squares, math::chiSquareQuantile(1e-4, 6000));
  EXPECT_LT(squares, math::chiSquareQuantile(1 - 1e-4, 6000));
  EXPECT_LT(std::abs(product), 4 * std::sqrt(3000));
}

TEST(WhiteAcceleration, ItsStartIsToldWithoutAHeading)
{
  using Start = core::ObjectStart;
  double squares = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed)
  {
    World world(shipped("glint-position"), seed);
    const Start& s = world.starts().targets.at(1);
    EXPECT_FALSE(s.value[Start::kTheta]);
    const double v = 10 / std::sqrt(2.0);
    squares += std::pow((s.get(Start::kX) - 500) / 10, 2) +
               std::pow((s.get(Start::kY) - 500) / 10, 2) + std::pow(s.get(Start::kVx) - v, 2) +
               std::pow(s.get(Start::kVy) - v, 2);
  }
  EXPECT_GT(squares, math::chiSquareQuantile(1e-4, 800));
  EXPECT_LT(squares, math::chiSquareQuantile(1 - 1e-4, 800));
}

std::shared_ptr<const NoiseLaw> law(double probability, Tail tail)
{
  return std::make_shared<NoiseLaw>(NoiseLaw::Settings{probability, tail, 3, 2});
}

TEST(LawScore, OfANormalLawIsItsOwn)
{
  for (const int size : {1, 2})
  {
    EXPECT_NEAR(LawScore(law(0, Tail::kStudent), size).information(), 1, 1e-6);
    EXPECT_NEAR(LawScore(law(1, Tail::kGaussian), size).information(), 1.0 / 9, 1e-6);
  }
}

// Of n coordinates with v degrees of freedom: (v + n) / (v + n + 2) of a Gaussian's.
TEST(LawScore, OfStudentsLawIsTheKnownOne)
{
  EXPECT_NEAR(LawScore(law(1, Tail::kStudent), 2).information() * 9, 4.0 / 6, 0.01);
  EXPECT_NEAR(LawScore(law(1, Tail::kStudent), 1).information() * 9, 3.0 / 5, 0.01);
}

TEST(LawScore, FallsAsOutliersGetMore)
{
  double last = 1;
  for (const double probability : {0.1, 0.3, 0.5, 1.0})
  {
    const double now = LawScore(law(probability, Tail::kStudent), 2).information();
    EXPECT_LT(now, last);
    last = now;
  }
  EXPECT_GT(last, 0.07);
}

// What is drawn in place of an error has the covariance that the bound has it by.
TEST(LawScore, HasTheInformationAsVariance)
{
  for (const Tail tail : {Tail::kStudent, Tail::kGaussian, Tail::kLaplace})
  {
    const auto some = law(0.3, tail);
    const LawScore score(some, 2);
    math::RandomStream random{9};
    double sum = 0;
    constexpr int kDraws = 200000;
    for (int i = 0; i < kDraws; ++i)
    {
      const double f = some->drawFactor(random), a = random.normal(), b = random.normal();
      const double q = f * (a * a + b * b);
      sum += 0.5 * q * std::pow(score.inverseFactor(q), 2) / kDraws;
    }
    EXPECT_NEAR(sum, score.information(), 0.01) << static_cast<int>(tail);
  }
  EXPECT_GT(LawScore(law(0.3, Tail::kStudent), 2).inverseFactor(1e30), 0);
}

// Without glint, linear observations: the bound is the Kalman filter's covariance, found here by
// hand for one axis.
TEST(GlintBound, OfALinearWorldIsTheKalmanFilters)
{
  Matrix2 P = Vector2(100, 1).asDiagonal(), F, Q;
  F << 1, 1, 0, 1;
  Q << 0.25, 0.5, 0.5, 1;
  double sum = P(0, 0);
  for (int k = 0; k < 100; ++k)
  {
    P = (F * P * F.transpose() + 0.01 * Q).eval();
    P = (P - P.col(0) * P.row(0) / (P(0, 0) + 100)).eval();
    sum += P(0, 0);
  }
  const auto b =
      posteriorBound(shipped("glint-position", {"target_sensor.glint_probability=0"}), 1);
  EXPECT_NEAR(b->targets.at(1).bound, std::sqrt(2 * sum / 101), 1e-6);
}

// Over seeds the efficient filter's mean square is the bound's, with glint too.
TEST(GlintBound, IsReachedOnAverage)
{
  for (const char* name : {"glint-position", "glint-polar"})
  {
    double variances = 0, squares = 0;
    for (std::uint64_t seed = 1; seed <= 300; ++seed)
    {
      const auto b = posteriorBound(shipped(name), seed);
      variances += std::pow(b->targets.at(1).bound, 2);
      squares += std::pow(b->targets.at(1).efficient, 2);
    }
    EXPECT_NEAR(squares / variances, 1, 0.1) << name;
  }
}

TEST(GlintBound, RisesWithTheProbability)
{
  double last = 0;
  for (const char* probability : {"0", "0.1", "0.3", "0.5"})
  {
    const auto b = posteriorBound(
        shipped("glint-polar", {std::string("target_sensor.glint_probability=") + probability}), 1);
    EXPECT_GT(b->targets.at(1).bound, last);
    last = b->targets.at(1).bound;
  }
}
}  // namespace
}  // namespace slamot::sim
