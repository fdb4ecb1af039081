#include <gtest/gtest.h>
#include <slamot/core/Error.h>
#include <slamot/laws/checkFilter.h>
#include <slamot/scans/ScanSlamFilter.h>
#include <slamot/scans/registerAll.h>

#include <cstring>
#include <limits>
#include <map>
#include <sstream>

#include "drawnHouse.h"

namespace slamot::scans
{
namespace
{
using namespace slamot::test;

std::unique_ptr<core::Filter> makeFilter(const std::string& keys = "",
                                         const core::FilterContext& context = {})
{
  registerAll();
  core::Config config = core::Config::parse("[scan-slam]\n" + keys, "test");
  auto filter = core::FilterRegistry::instance().make("scan-slam", config, context);
  config.requireAllRead();
  return filter;
}

std::vector<core::Step> roomSteps(std::uint64_t seed = 1)
{
  return stepsOf(room(), driveAlong({{1, 1}, {4, 1}, {4, 3.5}, {2, 3.5}, {1, 1}, {3, 1}}), seed);
}

bool sameBytes(const core::Estimate& a, const core::Estimate& b)
{
  return a.time == b.time && a.robot.mean == b.robot.mean && a.robot.cov == b.robot.cov;
}

TEST(ScanSlamFilter, ObeysTheFilterLaws)
{
  registerAll();
  laws::checkFilter("scan-slam");
}

TEST(ScanSlamFilter, PathHasAPoseForEveryStepWithOdometry)
{
  const auto filter = makeFilter();
  const auto steps = roomSteps();
  for (const core::Step& step : steps) filter->process(step);
  const auto path = filter->path();
  ASSERT_EQ(path.size(), steps.size() - 1);
  for (std::size_t i = 0; i < path.size(); ++i) EXPECT_EQ(path[i].time, steps[i + 1].time);
  EXPECT_EQ(path.back().pose, filter->estimate().robot.mean);
}

TEST(ScanSlamFilter, GivesTheSameBytesAgain)
{
  const auto a = makeFilter(), b = makeFilter("", {{}, 77, 4});
  for (const core::Step& step : roomSteps())
    ASSERT_TRUE(sameBytes(a->process(step).estimate, b->process(step).estimate)) << step.time;
  const auto pa = a->path(), pb = b->path();
  ASSERT_EQ(pa.size(), pb.size());
  for (std::size_t i = 0; i < pa.size(); ++i) EXPECT_EQ(pa[i].pose, pb[i].pose);
}

TEST(ScanSlamFilter, IsAsBeforeAfterAStepItRefuses)
{
  const auto clean = makeFilter(), disturbed = makeFilter();
  for (const core::Step& step : roomSteps())
  {
    core::Step back = step, broken = step;
    back.time -= 1.5;
    if (step.time > 0)
    {
      EXPECT_THROW(disturbed->process(back), core::Error);
    }
    broken.odometry = Gaussian<Pose2D>{};
    broken.odometry->mean.x = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(disturbed->process(broken), core::Error);
    ASSERT_TRUE(sameBytes(clean->process(step).estimate, disturbed->process(step).estimate));
  }
}

TEST(ScanSlamFilter, TakesScansThatMakeNoSense)
{
  const auto filter = makeFilter();
  auto steps = roomSteps();
  for (std::size_t i = 0; i < steps.size(); ++i)
  {
    auto scan = std::make_shared<core::LaserScan>(*steps[i].lasers.at(0));
    if (i % 5 == 1) scan->ranges.clear();
    if (i % 5 == 2) scan->ranges.assign(181, std::numeric_limits<float>::quiet_NaN());
    if (i % 5 == 3) scan->ranges.assign(181, 1e30f);
    if (i % 5 == 4) scan->pose_robot_sensor.phi = std::numeric_limits<double>::infinity();
    steps[i].lasers = {scan};
    if (i % 7 == 6) steps[i].lasers.clear();
    const core::Estimate e = filter->process(steps[i]).estimate;
    ASSERT_TRUE(std::isfinite(e.robot.mean.x + e.robot.mean.y + e.robot.mean.phi));
    ASSERT_TRUE(e.robot.cov.allFinite());
  }
}

TEST(ScanSlamFilter, SurvivesOdometryOutOfThisWorld)
{
  const auto filter = makeFilter();
  auto steps = roomSteps();
  for (std::size_t i = 1; i < steps.size(); i += 3)
  {
    steps[i].odometry->mean.x = i % 2 ? 1e150 : -1e9;
    steps[i].odometry->cov *= i % 2 ? 1e100 : 0;
  }
  for (const core::Step& step : steps) EXPECT_NO_THROW(filter->process(step));
}

TEST(ScanSlamFilter, FollowsByScansAloneAtAWalk)
{
  const auto drive = driveAlong({{1, 1}, {4, 1}, {4, 3.5}});
  auto steps = stepsOf(room(), drive, 4);
  core::Starts starts;
  starts.robot.emplace();
  starts.robot->value = {drive[0].x, drive[0].y, drive[0].phi};
  const auto filter = makeFilter("", {starts});
  for (core::Step& step : steps)
  {
    step.odometry.reset();
    filter->process(step);
  }
  const Pose2D error = math::between(drive.back(), filter->estimate().robot.mean);
  EXPECT_LT(std::hypot(error.x, error.y), 0.1);
  EXPECT_TRUE(filter->path().empty());
}

TEST(ScanSlamFilter, ScansOfSeveralLasersAreOne)
{
  const auto drive = driveAlong({{1, 1}, {4, 1}, {4, 3.5}, {2, 3.5}});
  auto steps = stepsOf(room(), drive, 5);
  math::RandomStream random{9};
  for (std::size_t i = 0; i < steps.size(); ++i)
  {
    const Pose2D mount{-0.2, 0, math::kPi};
    auto rear = scanFrom(room(), math::compose(drive[i], mount), random);
    rear->pose_robot_sensor = mount;
    steps[i].lasers.push_back(rear);
  }
  core::Starts starts;
  starts.robot.emplace();
  starts.robot->value = {drive[0].x, drive[0].y, drive[0].phi};
  const auto filter = makeFilter("", {starts});
  for (const core::Step& step : steps) filter->process(step);
  const Pose2D error = math::between(drive.back(), filter->estimate().robot.mean);
  EXPECT_LT(std::hypot(error.x, error.y), 0.05);
}

TEST(ScanSlamFilter, ShippedConfigurationHoldsTheDefaults)
{
  core::Config shipped = core::Config::load(SLAMOT_SOURCE_DIR "/config-ini/scan-slam.ini");
  core::Config empty;
  core::Params of(shipped, "scan-slam"), none(empty, "scan-slam");
  const std::size_t keys = of.keys().size();
  Settings::from(of), Settings::from(none);
  shipped.requireAllRead();
  EXPECT_EQ(of.keys().size(), keys);
  const auto values = [](const core::Config& c)
  {
    std::map<std::string, double> out;
    std::istringstream in(c.effectiveText());
    for (std::string line; std::getline(in, line);)
      if (const auto at = line.find('='); at != std::string::npos)
      {
        std::istringstream number(line.substr(at + 1));
        std::string key;
        std::istringstream(line) >> key;
        if (!(number >> out[key])) out.erase(key);
      }
    return out;
  };
  const auto a = values(shipped), b = values(empty);
  EXPECT_GT(a.size(), 25u);
  ASSERT_EQ(a.size(), b.size());
  for (const auto& [key, value] : a) EXPECT_NEAR(value, b.at(key), 1e-9) << key;
  EXPECT_EQ(keys, a.size() + 1);  // and the flag `loops`: nothing is left to its default
}

TEST(ScanSlamFilter, RefusesSettingsThatMakeNoSense)
{
  EXPECT_THROW(makeFilter("search_least_m = 2\n"), core::Error);
  EXPECT_THROW(makeFilter("search_least_deg = 100\n"), core::Error);
  EXPECT_THROW(makeFilter("match_score = 2\n"), core::Error);
  EXPECT_THROW(makeFilter("loop_vote = 2\n"), core::Error);
}
}  // namespace
}  // namespace slamot::scans
