#include <gtest/gtest.h>
#include <slamot/core/FilterRegistry.h>
#include <slamot/laws/checkFilter.h>
#include <slamot/scans/registerAll.h>

#include "../moving/scene.h"
#include "drawnHouse.h"

namespace slamot::scans
{
namespace
{
std::unique_ptr<core::Filter> makeFilter(const std::string& name, const std::string& keys = "",
                                         const core::FilterContext& context = {})
{
  registerAll();
  core::Config config = core::Config::parse("[" + name + "]\n" + keys, "test");
  auto filter = core::FilterRegistry::instance().make(name, config, context);
  config.requireAllRead();
  return filter;
}

constexpr double kStep = 0.08;  // [s]

/// The robot goes along a room of 10 m by 6 m, and a car overtakes it close by.
Pose2D robotAt(double t)
{
  return {-4 + 0.4 * t, -1.5, 0.1 * std::sin(t)};
}
Pose2D carAt(double t)
{
  return {-4.5 + std::max(0.0, t - 1.0), -0.7, 0};
}

/// Odometry errs by a tenth of the way and drifts in heading.
std::vector<core::Step> overtaken(std::uint64_t seed)
{
  math::RandomStream random{seed, 5};
  std::vector<core::Step> out;
  Pose2D before = robotAt(0);
  for (int i = 0; i * kStep < 8; ++i)
  {
    const double t = i * kStep;
    core::Step& step = out.emplace_back();
    step.time = t;
    if (i > 0)
    {
      Pose2D went = math::between(before, robotAt(t));
      went.x *= 1.1;
      went.phi += math::degToRad(0.2) * (1 + random.normal());
      step.odometry = Gaussian<Pose2D>{went, Vector3(2.5e-5, 1e-6, 5e-5).asDiagonal()};
    }
    before = robotAt(t);
    moving::test::World world;
    moving::test::addBox(world, {0, 0, 0}, 10, 6);
    moving::test::addBox(world, {1, 2, 0.3}, 0.8, 0.5);
    world.circles.push_back({{-2, 2.0}, 0.2});
    moving::test::addBox(world, carAt(t), 0.7, 0.35);
    step.lasers.push_back(std::make_shared<core::LaserScan>(
        moving::test::lookRound(world, robotAt(t), 0.01, seed * 1000 + i)));
  }
  return out;
}

core::FilterContext startingAt(const Pose2D& pose)
{
  core::FilterContext context;
  core::ObjectStart& robot = context.starts.robot.emplace();
  robot.value[core::ObjectStart::kX] = pose.x;
  robot.value[core::ObjectStart::kY] = pose.y;
  robot.value[core::ObjectStart::kTheta] = pose.phi;
  context.starts.time = 0;
  return context;
}
}  // namespace

TEST(ScanSlamotFilter, ObeysTheFilterLaws)
{
  registerAll();
  laws::LawOptions options;
  // Errors are below what is expected where a target may speed up and does not.
  options.targetNees = laws::NeesBand{0.0, 1.4, "the world has no laser, and its target is slow"};
  laws::checkFilter("scan-slamot", {}, options);
}

TEST(ScanSlamotFilter, IsScanSlamWhereNothingMoves)
{
  using namespace slamot::test;
  const auto both = makeFilter("scan-slamot"), slam = makeFilter("scan-slam");
  for (const core::Step& step :
       stepsOf(room(), driveAlong({{1, 1}, {4, 1}, {4, 3.5}, {2, 3.5}, {1, 1}}), 1))
  {
    const core::Estimate a = both->process(step).estimate, b = slam->process(step).estimate;
    EXPECT_TRUE(a.targets.empty());
    ASSERT_EQ(a.robot.mean, b.robot.mean) << step.time;
    ASSERT_EQ(a.robot.cov, b.robot.cov) << step.time;
  }
  EXPECT_EQ(both->path().size(), slam->path().size());
}

TEST(ScanSlamotFilter, FollowsTheCarFromWhereTheScansSayThatTheRobotIs)
{
  for (std::uint64_t seed = 1; seed <= 5; ++seed)
  {
    const auto filter = makeFilter("scan-slamot", "", startingAt(robotAt(0)));
    const auto odometry = makeFilter("scan-slamot", "ego = odometry", startingAt(robotAt(0)));
    int late = 0, seen = 0;
    double squared = 0;
    core::Estimate last, lastByOdometry;
    for (const core::Step& step : overtaken(seed))
    {
      last = filter->process(step).estimate;
      lastByOdometry = odometry->process(step).estimate;
      ASSERT_LE(last.targets.size(), 1u) << "seed " << seed << ", " << step.time << " s";
      if (step.time < 2.2) continue;
      ++late;
      if (last.targets.empty()) continue;
      ++seen;
      const Pose2D& at = last.targets[0].pose.mean;
      squared += std::pow(at.x - carAt(step.time).x, 2) + std::pow(at.y - carAt(step.time).y, 2);
    }
    const Pose2D truth = robotAt(last.time);
    const auto error = [&](const core::Estimate& e)
    { return std::hypot(e.robot.mean.x - truth.x, e.robot.mean.y - truth.y); };
    EXPECT_EQ(seen, late) << "seed " << seed;
    EXPECT_LT(std::sqrt(squared / seen), 0.15) << "seed " << seed;
    EXPECT_LT(error(last), 0.06) << "seed " << seed;
    EXPECT_GT(error(lastByOdometry), 0.25) << "seed " << seed;
  }
}

TEST(ScanSlamotFilter, ByOdometryTheRobotGoesByDeadReckoning)
{
  const auto filter = makeFilter("scan-slamot", "ego = odometry", startingAt(robotAt(0)));
  Gaussian<Pose2D> expected{robotAt(0), Matrix3::Zero()};
  for (const core::Step& step : overtaken(3))
  {
    if (step.odometry) expected = math::compose(expected, *step.odometry);
    const core::Estimate e = filter->process(step).estimate;
    ASSERT_EQ(e.robot.mean, expected.mean);
    ASSERT_EQ(e.robot.cov, expected.cov);
  }
  EXPECT_TRUE(filter->path().empty());
}

TEST(ScanSlamotFilter, TargetsOfTheStartAreThereBeforeTheFirstStep)
{
  core::FilterContext context = startingAt({});
  context.starts.targets[4].value[core::ObjectStart::kX] = 2;
  const auto filter = makeFilter("scan-slamot", "", context);
  ASSERT_EQ(filter->estimate().targets.size(), 1u);
  EXPECT_EQ(filter->estimate().targets[0].id, 4);
  EXPECT_NEAR(filter->estimate().targets[0].pose.mean.x, 2, 1e-12);
}
}  // namespace slamot::scans
