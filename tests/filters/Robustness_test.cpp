#include "drives.h"
#include "filterRig.h"

#include <slamot/math/random.h>

#include <functional>
#include <limits>

namespace slamot::filters
{
namespace
{
using test::bytes;
using test::keysOf;
using test::makeFilter;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// All four ways to run the filter.
class Way : public ::testing::TestWithParam<test::Way>
{
};
INSTANTIATE_TEST_SUITE_P(Each, Way, ::testing::ValuesIn(test::kWays), test::nameOf);

core::FilterContext contextOf(const laws::Drive& d, std::uint64_t seed = 1, int threads = 1)
{
  core::FilterContext c;
  c.starts = d.starts;
  c.seed = seed;
  c.threads = threads;
  return c;
}
}  // namespace

TEST_P(Way, BadStepsThrowAndLeaveNoTrace)
{
  const laws::Drive d = test::drive(GetParam(), 1);
  const std::vector<std::function<void(core::Step&)>> spoils = {
      [](core::Step& s) { s.time -= 1; },
      [](core::Step& s) { s.time = kNaN; },
      [](core::Step& s) { s.odometry->mean.x = kNaN; },
      [](core::Step& s) { s.odometry->cov(1, 1) = -1; },
      [](core::Step& s) { s.landmarks->sightings.at(0).range = kNaN; },
      [](core::Step& s) { s.landmarks->sightings.back().bearingStd = 0; },
      [](core::Step& s) { s.blobs->blobs.at(0).bearing = kNaN; },
      [](core::Step& s) { s.blobs->blobs.at(0).range = -1; }};
  const auto clean = makeFilter("rbpf-slamot", keysOf(GetParam()), contextOf(d));
  const auto tried = makeFilter("rbpf-slamot", keysOf(GetParam()), contextOf(d));
  int thrown = 0;
  for (const core::Step& step : d.steps)
  {
    const std::string before = bytes(*tried);
    for (const auto& spoil : spoils)
    {
      core::Step bad = step;
      if (!bad.landmarks || bad.landmarks->sightings.empty() || !bad.blobs ||
          bad.blobs->blobs.empty())
        continue;
      spoil(bad);
      EXPECT_THROW((void)tried->process(bad), core::Error);
      ++thrown;
      ASSERT_EQ(bytes(*tried), before);
    }
    (void)clean->process(step);
    (void)tried->process(step);
    ASSERT_EQ(bytes(*tried), bytes(*clean));
  }
  EXPECT_GT(thrown, 50);
}

TEST_P(Way, ThreadsDoNotChangeAByte)
{
  const laws::Drive d = test::drive(GetParam(), 2);
  const auto one = makeFilter("rbpf-slamot", keysOf(GetParam()), contextOf(d, 5, 1));
  const auto again = makeFilter("rbpf-slamot", keysOf(GetParam()), contextOf(d, 5, 1));
  const auto two = makeFilter("rbpf-slamot", keysOf(GetParam()), contextOf(d, 5, 2));
  const auto three = makeFilter("rbpf-slamot", keysOf(GetParam()), contextOf(d, 5, 3));
  const auto other = makeFilter("rbpf-slamot", keysOf(GetParam()), contextOf(d, 6, 1));
  for (const core::Step& step : d.steps)
  {
    for (core::Filter* f : {one.get(), again.get(), two.get(), three.get(), other.get()})
      (void)f->process(step);
    ASSERT_EQ(bytes(*one), bytes(*again));
    ASSERT_EQ(bytes(*one), bytes(*two));
    ASSERT_EQ(bytes(*one), bytes(*three));
  }
  EXPECT_NE(bytes(*one), bytes(*other));
}

// Same seed, another map frame: the same particles, moved and rotated.
TEST_P(Way, AnotherStartMovesAndRotatesTheEstimate)
{
  for (const Pose2D& by : {Pose2D{5, -3, 2.5}, Pose2D{-40, 7, -1.1}})
  {
    laws::Drive d = test::drive(GetParam(), 3), moved = test::drive(GetParam(), 3, by);
    for (laws::Drive* drive : {&d, &moved}) drive->starts.robot->std = {0.1, 0.1, 0.05};
    const auto a = makeFilter("rbpf-slamot", keysOf(GetParam()), contextOf(d));
    const auto b = makeFilter("rbpf-slamot", keysOf(GetParam()), contextOf(moved));
    for (std::size_t i = 0; i < d.steps.size(); ++i)
    {
      const core::Estimate e = a->process(d.steps[i]).estimate;
      const core::Estimate f = b->process(moved.steps[i]).estimate;
      const Pose2D expected = math::compose(by, e.robot.mean);
      ASSERT_NEAR(f.robot.mean.x, expected.x, 1e-7) << i;
      ASSERT_NEAR(f.robot.mean.y, expected.y, 1e-7) << i;
      ASSERT_NEAR(math::wrapToPi(f.robot.mean.phi - expected.phi), 0, 1e-7) << i;
      const Matrix3 R = math::poseRotation(by.phi);
      ASSERT_LE((R * e.robot.cov * R.transpose() - f.robot.cov).norm(), 1e-7) << i;
      ASSERT_EQ(e.targets.size(), f.targets.size());
      const auto m = test::landmarks(e), n = test::landmarks(f);
      ASSERT_EQ(m.size(), n.size());
      for (const auto& [id, l] : m)
      {
        const Point2D at = math::transform(by, l.position.mean);
        ASSERT_NEAR(n.at(id).position.mean.x, at.x, 1e-7);
        ASSERT_NEAR(n.at(id).position.mean.y, at.y, 1e-7);
      }
    }
  }
}

TEST_P(Way, CovariancesStayCovariancesWhereSensorsAreFarBetterThanOdometry)
{
  for (const double odometry : {1e-3, 1e-2, 0.1})
    for (const double sensor : {1e-2, 1e-4, 1e-6})
    {
      SCOPED_TRACE(std::to_string(odometry) + " " + std::to_string(sensor));
      laws::World world = test::worldOf(GetParam());
      world.speedStd = world.turnRateStd = odometry;
      world.rangeStd = world.bearingStd = sensor;
      const laws::Drive d = laws::drive(world, 4);
      const auto filter = makeFilter("rbpf-slamot", keysOf(GetParam()), contextOf(d));
      for (const core::Step& step : d.steps)
      {
        const core::Estimate e = filter->process(step).estimate;
        ASSERT_TRUE(e.robot.cov.allFinite());
        ASSERT_GE(math::smallestEigenvalue(e.robot.cov), -1e-9 * e.robot.cov.trace());
        for (const auto& t : e.targets)
        {
          ASSERT_GE(math::smallestEigenvalue(t.pose.cov), -1e-9 * t.pose.cov.trace());
          ASSERT_GE(math::smallestEigenvalue(t.velocityCov), -1e-9 * t.velocityCov.trace());
        }
      }
    }
}

TEST_P(Way, OneParticleAndNoneSeenWork)
{
  laws::Drive d = test::drive(GetParam(), 5);
  for (std::size_t i = 0; i < d.steps.size(); i += 3)
  {
    d.steps[i].landmarks.emplace();
    d.steps[i].blobs.emplace();
  }
  const auto filter = makeFilter("rbpf-slamot", keysOf(GetParam(), 1), contextOf(d));
  for (const core::Step& step : d.steps)
  {
    const core::Update u = filter->process(step);
    ASSERT_TRUE(u.estimate.robot.cov.allFinite());
    ASSERT_EQ(u.diagnostics.particles, 1);
    ASSERT_FALSE(u.diagnostics.resampled);
    ASSERT_EQ(u.estimate.time, step.time);
  }
  EXPECT_EQ(filter->particles().size(), 1u);
  EXPECT_EQ(filter->particles()[0].weight, 1);
}

// A landmark under the sensor has no bearing: it is neither used nor does it break anything.
TEST_P(Way, SightingsAtOneCentimetreDoNoHarm)
{
  core::FilterContext context;
  context.starts.time = 0.0;
  const auto filter = makeFilter("rbpf-slamot", keysOf(GetParam()), context);
  math::RandomStream random{6};
  for (int i = 0; i < 60; ++i)
  {
    core::Step step;
    step.time = 0.1 * i;
    step.odometry = Gaussian<Pose2D>{{0.002, 0, 0.01}, 1e-6 * Matrix3::Identity()};
    step.landmarks.emplace();
    for (int k = 0; k < 3; ++k)
      step.landmarks->sightings.push_back({random.uniform(1e-4, 0.03), random.uniform(-3, 3), 0.01,
                                           0.05, test::idOf(GetParam(), k)});
    step.landmarks->sightings.push_back({2.0, 0.5, 0.1, 0.02, test::idOf(GetParam(), 9)});
    step.blobs.emplace().blobs.push_back({"target", random.uniform(1e-4, 0.03), 0, 0.01, 0.05, 1});
    const core::Estimate e = filter->process(step).estimate;
    ASSERT_TRUE(e.robot.cov.allFinite());
    ASSERT_TRUE(std::isfinite(e.robot.mean.x + e.robot.mean.y + e.robot.mean.phi));
    ASSERT_LT(std::hypot(e.robot.mean.x, e.robot.mean.y), 1.0);
    for (const auto& [id, l] : test::landmarks(e)) ASSERT_TRUE(l.position.cov.allFinite());
  }
}
}  // namespace slamot::filters
