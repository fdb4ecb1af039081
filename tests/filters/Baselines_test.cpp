#include "drives.h"
#include "filterRig.h"

#include <slamot/math/statistics.h>

namespace slamot::filters
{
namespace
{
using test::bytes;
using test::makeFilter;

constexpr test::Way kWay{true, true, true};

core::FilterContext contextOf(const laws::Drive& d, std::uint64_t seed = 1)
{
  core::FilterContext c;
  c.starts = d.starts;
  c.seed = seed;
  return c;
}

/// The keys of a target's motion alone.
std::string targetKeys()
{
  const std::string keys = test::keysOf(kWay);
  return keys.substr(keys.find("target_motion"));
}

std::function<std::optional<Pose2D>(double)> truthOf(const laws::Drive& d)
{
  return [&d](double time) -> std::optional<Pose2D>
  {
    for (std::size_t i = 0; i < d.steps.size(); ++i)
      if (d.steps[i].time == time) return d.robot[i];
    return std::nullopt;
  };
}
}  // namespace

TEST(Odometry, HasTheRobotOfDeadReckoning)
{
  const auto d = test::drive(kWay, 1);
  const auto a = makeFilter("odometry", targetKeys(), contextOf(d));
  const auto b = makeFilter("dead-reckoning", "", contextOf(d));
  for (const core::Step& step : d.steps)
  {
    const auto e = a->process(step).estimate, f = b->process(step).estimate;
    ASSERT_EQ(e.robot.mean, f.robot.mean);
    ASSERT_EQ(e.robot.cov, f.robot.cov);
    ASSERT_EQ(e.targets.size(), 1u);
  }
}

TEST(Independent, HasTheRobotAndMapOfSlamWithoutTheTarget)
{
  const auto d = test::drive(kWay, 2);
  core::FilterContext context = contextOf(d);
  const auto independent = makeFilter("independent", test::keysOf(kWay), context);
  context.starts.targets.clear();
  const auto slam = makeFilter("rbpf-slamot", test::keysOf(kWay), context);
  for (core::Step step : d.steps)
  {
    const auto e = independent->process(step).estimate;
    step.blobs.reset();
    const auto f = slam->process(step).estimate;
    ASSERT_EQ(e.robot.mean, f.robot.mean);
    ASSERT_EQ(e.robot.cov, f.robot.cov);
    ASSERT_EQ(test::landmarks(e).size(), test::landmarks(f).size());
    ASSERT_EQ(e.targets.size(), 1u);
  }
}

// One particle, odometry without error: then all of them follow the target from the same pose.
TEST(Baselines, AgreeWithTheJointFilterWhereThePoseIsKnown)
{
  laws::World world = test::worldOf(kWay);
  world.speedStd = world.turnRateStd = 0;
  const auto d = laws::drive(world, 3);
  core::FilterContext context = contextOf(d);
  context.truePose = truthOf(d);
  const auto joint = makeFilter("rbpf-slamot", test::keysOf(kWay, 1), context);
  const auto independent = makeFilter("independent", test::keysOf(kWay, 1), context);
  const auto odometry = makeFilter("odometry", targetKeys(), context);
  const auto bound = makeFilter("true-pose-target", targetKeys(), context);
  for (const core::Step& step : d.steps)
  {
    const auto expected = joint->process(step).estimate.targets.at(0);
    for (core::Filter* f : {independent.get(), odometry.get(), bound.get()})
    {
      const auto t = f->process(step).estimate.targets.at(0);
      ASSERT_NEAR(t.pose.mean.x, expected.pose.mean.x, 1e-9);
      ASSERT_NEAR(t.pose.mean.y, expected.pose.mean.y, 1e-9);
      ASSERT_LE((t.pose.cov - expected.pose.cov).norm(), 1e-9);
      ASSERT_LE((t.velocity - expected.velocity).norm(), 1e-9);
    }
  }
}

TEST(TruePoseTarget, HasTheTruePoseAndATargetThatIsConsistent)
{
  double nees = 0;
  constexpr int kRuns = 100;
  for (std::uint64_t seed = 1; seed <= kRuns; ++seed)
  {
    const auto d = test::drive(kWay, seed);
    core::FilterContext context = contextOf(d);
    context.truePose = truthOf(d);
    const auto f = makeFilter("true-pose-target", targetKeys(), context);
    for (std::size_t i = 0; i < d.steps.size(); ++i)
    {
      const auto e = f->process(d.steps[i]).estimate;
      ASSERT_EQ(e.robot.mean, d.robot[i]);
      ASSERT_TRUE(e.robot.cov.isZero());
    }
    const auto t = f->estimate().targets.at(0).pose;
    const Pose2D& truth = d.targets.back().at(0);
    nees += math::mahalanobisSquared(
        Vector3(truth.x - t.mean.x, truth.y - t.mean.y, math::wrapToPi(truth.phi - t.mean.phi)),
        t.cov);
  }
  EXPECT_LT(nees, math::chiSquareQuantile(0.9999, 3 * kRuns));
  EXPECT_GT(nees, math::chiSquareQuantile(0.0001, 3 * kRuns));
}

TEST(TruePoseTarget, NeedsATruthThatReachesItsBlobs)
{
  const auto d = test::drive(kWay, 4);
  EXPECT_THROW((void)makeFilter("true-pose-target", targetKeys(), contextOf(d)), core::Error);
  core::FilterContext context = contextOf(d);
  const auto truth = truthOf(d);
  context.truePose = [&](double time) { return time < 3.01 ? truth(time) : std::nullopt; };
  const auto f = makeFilter("true-pose-target", targetKeys(), context);
  int thrown = 0;
  for (const core::Step& step : d.steps)
  {
    const bool hasBlob = step.blobs && !step.blobs->blobs.empty();
    if (step.time > 3.01 && hasBlob)
    {
      const std::string before = bytes(*f);
      EXPECT_THROW((void)f->process(step), core::Error);
      EXPECT_EQ(bytes(*f), before);
      ++thrown;
    }
    else
      EXPECT_NO_THROW((void)f->process(step));
  }
  EXPECT_GT(thrown, 2);
}
}  // namespace slamot::filters
