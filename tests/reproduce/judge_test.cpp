#include <gtest/gtest.h>
#include <slamot/filters/registerAll.h>
#include <slamot/reproduce/judge.h>
#include <slamot/study/Metrics.h>

#include <cmath>

#include "tinyPaper.h"

namespace slamot::reproduce::test
{
namespace
{
using Values = std::vector<std::optional<double>>;

/// The tiny study with made-up errors of the robot: by cell (3 or 8 landmarks) and method (joint,
/// odometry), for four seeds.
class Judge : public ::testing::Test
{
 protected:
  Judge()
  {
    filters::registerAll();
    plan_ = std::make_unique<study::Plan>(study_.spec());
    for (const study::Run& run : plan_->runs)
    {
      study::RunRecord record;
      record.seed = run.seed;
      record.metrics.resize(study::metrics().size());
      outcome_.records.emplace_back(record);
    }
  }

  void set(std::size_t cell, std::size_t method, const Values& values,
           const char* metric = "robot_mean_m")
  {
    const std::size_t group = plan_->groupOf[cell][method];
    for (std::size_t s = 0; s < values.size(); ++s)
      outcome_.records[plan_->runAt(group, static_cast<int>(s))]
          ->metrics[*study::metricByName(metric)] = values[s];
  }

  [[nodiscard]] Judgement verdict(const std::vector<std::string>& conditions) const
  {
    Claim claim;
    for (const std::string& text : conditions) claim.parts.push_back({"", parseCondition(text)});
    return judge(claim, plan_.get(), &outcome_);
  }
  [[nodiscard]] Status status(const std::string& condition) const
  {
    const auto checks = verdict({condition}).checks;
    EXPECT_EQ(checks.size(), 1u);
    return checks.at(0).status;
  }

  study::test::TinyStudy study_;
  std::unique_ptr<study::Plan> plan_;
  study::Outcome outcome_;
};

math::MeanInterval interval(double mean, double half, int count = 10)
{
  return {mean, half, half, count};
}
}  // namespace

TEST(StatusOf, BoundsAreMetByWholeIntervals)
{
  const Bound below = parseCondition("a(x) < 1").bound;
  EXPECT_EQ(statusOf(interval(0.8, 0.1), below), Status::kMet);
  EXPECT_EQ(statusOf(interval(0.95, 0.1), below), Status::kOpen);
  EXPECT_EQ(statusOf(interval(1.05, 0.1), below), Status::kOpen);
  EXPECT_EQ(statusOf(interval(1.2, 0.1), below), Status::kFailed);
  const Bound above = parseCondition("a(x) > 1").bound;
  EXPECT_EQ(statusOf(interval(1.2, 0.1), above), Status::kMet);
  EXPECT_EQ(statusOf(interval(0.95, 0.1), above), Status::kOpen);
  EXPECT_EQ(statusOf(interval(0.8, 0.1), above), Status::kFailed);
  const Bound between = parseCondition("a(x) in 0.9 .. 1.1").bound;
  EXPECT_EQ(statusOf(interval(1.0, 0.05), between), Status::kMet);
  EXPECT_EQ(statusOf(interval(1.0, 0.2), between), Status::kOpen);
  EXPECT_EQ(statusOf(interval(1.08, 0.05), between), Status::kOpen);
  EXPECT_EQ(statusOf(interval(1.3, 0.1), between), Status::kFailed);
}

TEST(StatusOf, OneRunDecidesNothing)
{
  const Bound below = parseCondition("a(x) < 1").bound;
  EXPECT_EQ(statusOf(interval(0.1, 0, 1), below), Status::kOpen);
  EXPECT_EQ(statusOf(interval(0, 0, 0), below), Status::kNotRun);
}

TEST(StatusOf, PublishedMeansAreMetWithinTheirDeviation)
{
  const Bound published = parseCondition("a(x) = 1 +- 0.2").bound;
  EXPECT_EQ(statusOf(interval(1.15, 0.5), published), Status::kMet);
  EXPECT_EQ(statusOf(interval(1.25, 0.1), published), Status::kOpen);
  EXPECT_EQ(statusOf(interval(1.25, 0.01), published), Status::kFailed);
  EXPECT_EQ(statusOf(interval(0.5, 0.1), published), Status::kFailed);
  const Bound atMost = parseCondition("a(x) <= 1 +- 0.2").bound;
  EXPECT_EQ(statusOf(interval(0.5, 0.1), atMost), Status::kMet);
  EXPECT_EQ(statusOf(interval(1.5, 0.1), atMost), Status::kFailed);
  const Bound atLeast = parseCondition("a(x) >= 1 +- 0.2").bound;
  EXPECT_EQ(statusOf(interval(1.5, 0.1), atLeast), Status::kMet);
  EXPECT_EQ(statusOf(interval(0.5, 0.1), atLeast), Status::kFailed);
}

TEST(StatusOf, PublishedRunsAreMetIfAsManyRunsCouldGiveThem)
{
  // Ten runs here, half width 0.1: the mean of ten more lies within 0.1 sqrt(1 + 10 / 10).
  const Bound ten = parseCondition("a(x) = 1 of 10 runs").bound;
  EXPECT_EQ(statusOf(interval(1 + 0.1 * std::sqrt(2) - 1e-9, 0.1), ten), Status::kMet);
  EXPECT_EQ(statusOf(interval(1 + 0.1 * std::sqrt(2) + 1e-9, 0.1), ten), Status::kFailed);
  EXPECT_EQ(statusOf(interval(0.5, 0.1), ten), Status::kFailed);
  // One run says less than ten.
  const Bound one = parseCondition("a(x) = 1 of 1 runs").bound;
  EXPECT_EQ(statusOf(interval(1.3, 0.1), one), Status::kMet);
  const Bound atMost = parseCondition("a(x) <= 1 of 10 runs").bound;
  EXPECT_EQ(statusOf(interval(0.5, 0.1), atMost), Status::kMet);
  EXPECT_EQ(statusOf(interval(1.5, 0.1), atMost), Status::kFailed);
}

TEST_F(Judge, AllMetHoldsNoneMetDoesNotElseInPart)
{
  set(0, 0, {1.0, 1.1, 0.9, 1.0});
  set(0, 1, {2.0, 2.1, 1.9, 2.0});
  const std::string met = "robot_mean_m(joint, landmarks=3) < 1.5";
  const std::string failed = "robot_mean_m(odometry, landmarks=3) < 1.5";
  const std::string open = "robot_mean_m(joint, landmarks=3) < 1.01";
  EXPECT_EQ(verdict({met}).verdict, Verdict::kHolds);
  EXPECT_EQ(verdict({failed}).verdict, Verdict::kDoesNotHold);
  EXPECT_EQ(verdict({met, failed}).verdict, Verdict::kInPart);
  EXPECT_EQ(verdict({met, open}).verdict, Verdict::kInPart);
  EXPECT_FALSE(verdict({met, open}).isUndecided);
  EXPECT_EQ(verdict({failed, open}).verdict, Verdict::kInPart);
  EXPECT_EQ(verdict({open, open}).verdict, Verdict::kInPart);
  EXPECT_TRUE(verdict({open, open}).isUndecided);
}

TEST_F(Judge, RatiosArePairedBySeed)
{
  // Each seed's ratio is 1.1 but its difficulty varies tenfold: unpaired, nothing would be told.
  set(0, 0, {1.1, 11.0, 5.5, 2.2});
  set(0, 1, {1.0, 10.0, 5.0, 2.0});
  EXPECT_EQ(status("robot_mean_m(joint, landmarks=3) / robot_mean_m(odometry, landmarks=3) > 1.05"),
            Status::kMet);
  EXPECT_EQ(status("robot_mean_m(joint, landmarks=3) / robot_mean_m(odometry, landmarks=3) < 1"),
            Status::kFailed);
  EXPECT_EQ(verdict({"robot_mean_m(joint, landmarks=3) / robot_mean_m(odometry, landmarks=3) < 1"})
                .checks[0]
                .measured,
            "1.100 ± 0.000");
}

TEST_F(Judge, CellsAndMetricsAreComparedWithEachOther)
{
  set(0, 0, {2.0, 2.1, 1.9, 2.0});
  set(1, 0, {1.0, 1.1, 0.9, 1.0});
  set(1, 0, {0.5, 0.5, 0.5, 0.5}, "target_mean_m");
  EXPECT_EQ(
      status("robot_mean_m(joint, landmarks=8) / robot_mean_m(joint, landmarks=3) in 0.4 .. 0.6"),
      Status::kMet);
  EXPECT_EQ(status("target_mean_m(joint, landmarks=8) / robot_mean_m(joint, landmarks=8) < 0.6"),
            Status::kMet);
  EXPECT_EQ(
      status("robot_mean_m(joint, landmarks=3) - robot_mean_m(joint, landmarks=8) in 0.9 .. 1.1"),
      Status::kMet);
}

TEST_F(Judge, GrowthIsARatioOfDifferences)
{
  set(0, 0, {3.0, 4.0, 5.0, 6.0});
  set(0, 0, {1.0, 2.0, 3.0, 4.0}, "target_mean_m");
  set(0, 1, {9.0, 9.0, 9.0, 9.0});
  set(0, 1, {5.0, 5.0, 5.0, 5.0}, "target_mean_m");
  EXPECT_EQ(status("(robot_mean_m(joint, landmarks=3) - target_mean_m(joint, landmarks=3)) / "
                   "(robot_mean_m(odometry, landmarks=3) - target_mean_m(odometry, landmarks=3)) "
                   "in 0.499 .. 0.501"),
            Status::kMet);
}

// -1 is below 1, but not because the first grew less.
TEST_F(Judge, ADivisorThatMayBeNegativeDecidesNothing)
{
  const char* growth =
      "(robot_mean_m(joint, landmarks=3) - target_mean_m(joint, landmarks=3)) / "
      "(robot_mean_m(odometry, landmarks=3) - target_mean_m(odometry, landmarks=3)) < 1";
  set(0, 0, {3.0, 4.0, 5.0, 6.0});
  set(0, 0, {1.0, 2.0, 3.0, 4.0}, "target_mean_m");
  set(0, 1, {5.0, 5.0, 5.0, 5.0});
  set(0, 1, {7.0, 7.0, 7.0, 7.0}, "target_mean_m");
  EXPECT_EQ(status(growth), Status::kOpen);
  EXPECT_EQ(verdict({growth}).checks[0].remark, "what it is divided by may be 0 or less");
  set(0, 1, {-9.0, 1.0, 2.0, 3.5}, "target_mean_m");  // the divisor's interval reaches below 0
  set(0, 1, {-9.5, 1.5, 2.5, 4.0});
  EXPECT_EQ(verdict({growth}).checks[0].remark, "what it is divided by may be 0 or less");
}

TEST_F(Judge, WhatOnlySomeRunsHaveDecidesNothingAndIsSaid)
{
  set(0, 0, {1.0, {}, 1.01, 0.99});
  const Check check = verdict({"robot_mean_m(joint, landmarks=3) < 2"}).checks.at(0);
  EXPECT_EQ(check.status, Status::kOpen);
  EXPECT_NE(check.measured.find("(3 of 4 runs)"), std::string::npos) << check.measured;
}

TEST_F(Judge, OpenAxesAreCheckedInEachCell)
{
  set(0, 0, {1.0, 1.1, 0.9, 1.0});
  set(1, 0, {3.0, 3.1, 2.9, 3.0});
  const Judgement j = verdict({"robot_mean_m(joint) < 2"});
  ASSERT_EQ(j.checks.size(), 2u);
  EXPECT_EQ(j.checks[0].status, Status::kMet);
  EXPECT_EQ(j.checks[1].status, Status::kFailed);
  EXPECT_NE(j.checks[0].what.find("landmarks 3"), std::string::npos) << j.checks[0].what;
  EXPECT_EQ(j.verdict, Verdict::kInPart);
}

TEST_F(Judge, TimeIsTakenFromTheRecords)
{
  for (auto& record : outcome_.records) record->cpuS = 2 + 0.01 * static_cast<double>(record->seed);
  EXPECT_EQ(status("cpu_s(joint, landmarks=3) in 1.9 .. 2.2"), Status::kMet);
}

TEST_F(Judge, WhatWasNotRunIsNoVerdict)
{
  EXPECT_EQ(verdict({"robot_mean_m(joint) < 2"}).verdict, Verdict::kNotRun);
  for (auto& record : outcome_.records) record.reset();
  EXPECT_EQ(verdict({"robot_mean_m(joint) < 2"}).verdict, Verdict::kNotRun);
  Claim claim;
  claim.parts.push_back({"", parseCondition("robot_mean_m(joint) < 2")});
  EXPECT_EQ(judge(claim, nullptr, nullptr).verdict, Verdict::kNotRun);
}

TEST_F(Judge, NothingByNothingIsNoNumberButADifferenceIs)
{
  for (std::size_t method : {0u, 1u}) set(0, method, {0.0, 0.0, 0.0, 0.0});
  EXPECT_EQ(status("robot_mean_m(joint, landmarks=3) / robot_mean_m(odometry, landmarks=3) < 1"),
            Status::kNotRun);
  EXPECT_EQ(status("robot_mean_m(joint, landmarks=3) - robot_mean_m(odometry, landmarks=3) < 0"),
            Status::kFailed);
}

TEST_F(Judge, MissingNumbersKeepAClaimFromHolding)
{
  set(0, 0, {1.0, 1.1, 0.9, 1.0});  // the other cell has none
  EXPECT_EQ(verdict({"robot_mean_m(joint) < 2"}).verdict, Verdict::kInPart);
}

TEST_F(Judge, WhatIsLeftOutIsSaidAndDoesNotCount)
{
  set(0, 0, {1.0, 1.1, 0.9, 1.0});
  const Judgement j =
      verdict({"robot_mean_m(joint, landmarks=3) < 2", "robot_mean_m(joint, landmarks=20) < 2"});
  ASSERT_EQ(j.checks.size(), 2u);
  EXPECT_EQ(j.checks[1].status, Status::kLeftOut);
  EXPECT_EQ(j.verdict, Verdict::kHolds);
  EXPECT_EQ(verdict({"robot_mean_m(nobody) < 2"}).verdict, Verdict::kNotRun);
}

TEST_F(Judge, UntestableClaimsAreNotJudged)
{
  Claim claim;
  claim.untestable = "no data";
  EXPECT_EQ(judge(claim, plan_.get(), &outcome_).verdict, Verdict::kNotTestable);
}

TEST_F(Judge, TellsHowFarOffAPublishedValueIs)
{
  set(0, 0, {1.0, 1.1, 0.9, 1.0});
  auto check = verdict({"robot_mean_m(joint, landmarks=3) = 1.5 +- 0.1"}).checks.at(0);
  EXPECT_EQ(check.claimed, "published 1.5 (0.1)");
  EXPECT_EQ(check.remark, "5.0 deviations below: smaller than published");
  check = verdict({"robot_mean_m(joint, landmarks=3) = 0.5 of 10 runs"}).checks.at(0);
  EXPECT_EQ(check.claimed, "published 0.5, 10 runs");
  EXPECT_EQ(check.remark.rfind("100% above; 10 runs here would give 0.8", 0), 0u) << check.remark;
}
}  // namespace slamot::reproduce::test
