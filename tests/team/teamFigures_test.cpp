#include "twoRobots.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace slamot::team
{
namespace
{
std::size_t marksIn(const results::Plot& plot)
{
  std::size_t out = 0;
  for (const auto& s : plot.series)
    if (s.kind == results::Series::Kind::kDots) out += s.x.size();
  return out;
}

std::size_t fused(const Team& team, std::size_t robot)
{
  const auto& events = team.events(robot);
  return static_cast<std::size_t>(std::count_if(
      events.begin(), events.end(),
      [](const fusion::FusionEvent& e) { return e.receipt.outcome == fusion::Outcome::kFused; }));
}

const results::Series* named(const results::Figure& figure, const std::string& title)
{
  for (const auto& s : figure.panels.front().series)
    if (s.title == title) return &s;
  return nullptr;
}
}  // namespace

TEST(TeamFigures, ShowEveryRobotAndEveryFusion)
{
  const TwoRobots run("rule = ci\nexchange_every = 5\n");
  const TeamView view = run.view();
  const std::size_t fusions = fused(run.team(), 0) + fused(run.team(), 1);
  ASSERT_GT(fusions, 0u);
  for (const char* name : {"left", "right"})
  {
    ASSERT_TRUE(named(teamMapFigure(view), name));
    EXPECT_EQ(named(teamMapFigure(view), name)->x.size(), 61u);
  }
  EXPECT_EQ(marksIn(uncertaintyFigure(view).panels.front()), fusions);
  ASSERT_TRUE(omegaFigure(view));
  EXPECT_EQ(marksIn(omegaFigure(view)->panels.front()), fusions);
  EXPECT_TRUE(robotErrorsFigure(view));
  EXPECT_TRUE(targetErrorsFigure(view));
  ASSERT_TRUE(teamNeesFigure(view));
  EXPECT_EQ(teamNeesFigure(view)->panels.size(), 2u);
}

TEST(TeamFigures, PickAHandfulOfFusionsSpreadOverTheRun)
{
  const TwoRobots run("rule = ci\nomega = 0.7\n");  // fixed, so that every message is fused
  const TeamView view = run.view();
  ASSERT_EQ(fused(run.team(), 0), 60u);
  const auto some = someFusions(view, 0);
  ASSERT_EQ(some.size(), 6u);
  for (std::size_t i = 1; i < some.size(); ++i)
    EXPECT_NEAR(some[i].time - some[i - 1].time, 2, 0.21) << "12 s in six parts";
}

TEST(TeamFigures, EnlargeEllipsesButNeverShrinkThem)
{
  const TwoRobots run("rule = ci\nomega = 0.7\n");
  EXPECT_GE(ellipseScale(run.view()), 1);
  const Gaussian<Point2D> g{{3, 4}, Vector2(1, 2).asDiagonal()};
  EXPECT_EQ(enlarged(g, 10).mean.x, 3);
  EXPECT_NEAR(enlarged(g, 10).cov(1, 1), 200, 1e-9);
}

TEST(TeamFigures, WithoutTruthThereAreNoErrors)
{
  const TwoRobots run("rule = ci\n", false);
  EXPECT_FALSE(robotErrorsFigure(run.view()));
  EXPECT_FALSE(targetErrorsFigure(run.view()));
  EXPECT_FALSE(teamNeesFigure(run.view()));
  EXPECT_FALSE(named(teamMapFigure(run.view()), "true paths"));
}

TEST(TeamFigures, WithoutFusionThereIsNoWeight)
{
  const TwoRobots run("rule = none\n");
  EXPECT_FALSE(omegaFigure(run.view()));
  EXPECT_EQ(ellipseScale(run.view()), 1);
}

TEST(MessageTable, LeavesOutZerosAndKeepsTheSum)
{
  const TwoRobots run("rule = none\n");
  const auto table = messageTable(run.team(), run.results());
  ASSERT_EQ(table.header, (std::vector<std::string>{"", "left", "right"}));
  std::vector<std::string> names;
  for (const auto& row : table.rows) names.push_back(row.front());
  const auto has = [&](const char* n) { return std::count(names.begin(), names.end(), n) == 1; };
  EXPECT_TRUE(has("sent"));
  EXPECT_TRUE(has("fusion off"));
  EXPECT_TRUE(has("received: the sum of outcomes"));
  EXPECT_FALSE(has("fused"));
  EXPECT_FALSE(has("wrong checksum"));
}

TEST(MessageTable, IsEmptyWhereOneFilterTakesInAll)
{
  const TwoRobots run("rule = centralized\n");
  EXPECT_TRUE(messageTable(run.team(), run.results()).rows.empty());
}
}  // namespace slamot::team
