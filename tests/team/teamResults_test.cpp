#include "twoRobots.h"

#include <slamot/core/Error.h>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace slamot::team
{
namespace
{
/// One fusion at 1 s of a candidate that robot 1 saw.
std::vector<fusion::FusionEvent> fusionOf(double range, double bearing)
{
  fusion::FusionEvent e;
  e.time = e.sent = 1;
  e.receipt.outcome = fusion::Outcome::kFused;
  e.receipt.sender = 1;
  e.receipt.candidate = 0;
  e.candidate.range = range, e.candidate.bearing = bearing;
  e.candidate.rangeStd = 0.2, e.candidate.bearingStd = 0.01;
  return {e};
}

eval::Truth standingAt(const Pose2D& pose)
{
  eval::Truth out;
  for (const double t : {0.0, 2.0}) out.robot.poses.push_back({t, pose});
  return out;
}
}  // namespace

TEST(RobotNumbers, AreThoseOfTheNamesOnlyWhereAllHaveOne)
{
  EXPECT_EQ(robotNumbers({"a.robot3", "b.robot12"}), (std::vector<int>{3, 12}));
  EXPECT_EQ(robotNumbers({"a.robot3", "b"}), (std::vector<int>{0, 1}));
  EXPECT_EQ(robotNumbers({"robot3.a", "x"}), (std::vector<int>{0, 1}));
  EXPECT_EQ(numberIn("x.robot007"), 7);
  EXPECT_EQ(numberIn("x.robot1234567"), std::nullopt) << "no number of seven digits";
  EXPECT_EQ(numberIn("x.robot"), std::nullopt);
}

TEST(Team, TwoRobotsOfOneNumberAreRefused)
{
  filters::registerAll();
  AlongTheTarget a(5, 1), b(-5, 1);
  core::Config config = core::Config::parse("[ekf-slamot]\n[team]\n", "test");
  try
  {
    const Team team(config, {{4, &a, a.starts()}, {4, &b, b.starts()}}, 1, 1);
    FAIL() << "both were taken";
  }
  catch (const core::Error& e)
  {
    EXPECT_NE(std::string(e.what()).find("two robots have the number 4"), std::string::npos);
  }
}

TEST(Summarise, ACandidateIsWrongFiveDeviationsFromTheTruth)
{
  const eval::Truth sender = standingAt({0, 0, 0.5}), own = standingAt({10, 0, 0});
  const std::map<int, const eval::Truth*> truths{{1, &sender}};
  const double own5 = 5 * std::hypot(0.2, 10 * 0.01);
  const auto right = summarise(fusionOf(10, -0.5), own, truths);
  EXPECT_EQ(right.fused, 1);
  EXPECT_EQ(right.candidates, 1);
  EXPECT_EQ(right.wrongCandidates, 0);
  EXPECT_EQ(summarise(fusionOf(10 + 0.95 * own5, -0.5), own, truths).wrongCandidates, 0);
  EXPECT_EQ(summarise(fusionOf(10 + 1.1 * own5, -0.5), own, truths).wrongCandidates, 1);
  EXPECT_EQ(summarise(fusionOf(10, -0.3), own, truths).wrongCandidates, 1);
}

TEST(Summarise, WithoutTruthNoneIsKnownToBeWrong)
{
  const auto s = summarise(fusionOf(10, 0), {}, {});
  EXPECT_EQ(s.fused, 1);
  EXPECT_FALSE(s.wrongCandidates);
}

TEST(TeamJson, HoldsEveryRobotsNumbersAndTheirMeans)
{
  const TwoRobots run("rule = ci\n");
  const auto json = nlohmann::json::parse(teamJson(run.team(), run.results(), 1, {}));
  ASSERT_EQ(json["robots"].size(), 2u);
  double sum = 0;
  for (const auto& robot : json["robots"])
  {
    sum += robot["target"]["position_mean_error_m"].get<double>();
    std::int64_t outcomes = 0;
    for (int i = 0; i < static_cast<int>(fusion::Outcome::kCount); ++i)
      outcomes += robot["messages"]["by_outcome"][name(static_cast<fusion::Outcome>(i))]
                      .get<std::int64_t>();
    EXPECT_EQ(outcomes, robot["messages"]["received"]);
    EXPECT_EQ(robot["messages"]["received"], 60);
  }
  EXPECT_NEAR(json["team"]["target_position_mean_error_m"].get<double>(), sum / 2, 1e-12);
}

TEST(TeamJson, IsNullWhereThereIsNoTruth)
{
  const TwoRobots run("rule = ci\n", false);
  const auto json = nlohmann::json::parse(teamJson(run.team(), run.results(), 1, {}));
  EXPECT_TRUE(json["team"]["robot_position_mean_error_m"].is_null());
  EXPECT_TRUE(json["robots"][0]["messages"]["wrong_candidates_fused"].is_null());
}
}  // namespace slamot::team
