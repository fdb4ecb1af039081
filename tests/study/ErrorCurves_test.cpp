#include <slamot/core/Error.h>
#include <slamot/filters/registerAll.h>
#include <slamot/study/ErrorCurves.h>
#include <slamot/study/Metrics.h>

#include "tinyStudy.h"

namespace slamot::study::test
{
namespace
{
/// A run of so many rows, a second apart, whose robot errs by the row's number [m].
struct MadeUpRun
{
  explicit MadeUpRun(std::size_t rows, double scale = 1)
  {
    for (std::size_t i = 0; i < rows; ++i)
    {
      eval::RobotRow row;
      row.time = 100 + static_cast<double>(i);
      record.rows.push_back(row);
      eval::StepError s;
      s.row = i;
      s.error = {scale * static_cast<double>(i), 0, -0.25};
      s.headingKnown = i > 0;
      evaluation.robot.steps.push_back(s);
    }
  }
  eval::Record record;
  eval::Truth truth;
  eval::Evaluation evaluation;
};
using Values = std::vector<std::optional<double>>;
}  // namespace

TEST(ErrorCurves, AreMeansOverEqualPartsOfTheTime)
{
  const MadeUpRun run(9);
  const auto curves = errorCurves({{&run.record, &run.truth}}, {run.evaluation}, 4);
  EXPECT_DOUBLE_EQ(curves.durationS, 8);
  ASSERT_TRUE(curves.named("robot_position_m"));
  // Parts of 2 s: rows 0 1, 2 3, 4 5, 6 7 8.
  EXPECT_EQ(curves.named("robot_position_m")->values, (Values{0.5, 2.5, 4.5, 7.0}));
  ASSERT_TRUE(curves.named("robot_heading_rad"));
  EXPECT_EQ(curves.named("robot_heading_rad")->values, (Values{0.25, 0.25, 0.25, 0.25}));
  EXPECT_FALSE(curves.named("target_position_m"));
  EXPECT_FALSE(curves.named("robot0_position_m"));
}

TEST(ErrorCurves, PartsWithoutErrorsAreAbsent)
{
  MadeUpRun run(9);
  auto& steps = run.evaluation.robot.steps;
  steps.erase(steps.begin() + 2, steps.begin() + 4);
  const auto curves = errorCurves({{&run.record, &run.truth}}, {run.evaluation}, 4);
  EXPECT_EQ(curves.named("robot_position_m")->values, (Values{0.5, std::nullopt, 4.5, 7.0}));
}

TEST(ErrorCurves, OfATeamAreTheMeanAndEachRobots)
{
  const MadeUpRun a(4, 1), b(4, 3);
  const auto curves =
      errorCurves({{&a.record, &a.truth}, {&b.record, &b.truth}}, {a.evaluation, b.evaluation}, 1);
  EXPECT_EQ(curves.named("robot_position_m")->values, (Values{3.0}));
  EXPECT_EQ(curves.named("robot0_position_m")->values, (Values{1.5}));
  EXPECT_EQ(curves.named("robot1_position_m")->values, (Values{4.5}));
}

TEST(ErrorCurves, NamesAreThoseOfRobotsAndTargets)
{
  for (const char* name : {"robot_position_m", "robot12_heading_rad", "target_heading_rad"})
    EXPECT_TRUE(isCurveName(name)) << name;
  for (const char* name : {"", "robot", "robotx_position_m", "target1_position_m", "robot_mean_m"})
    EXPECT_FALSE(isCurveName(name)) << name;
  EXPECT_EQ(curveLabel("robot1_heading_rad"), "robot 1 heading error [rad]");
}

TEST(ErrorCurves, StudyKeepsAndPlotsThem)
{
  filters::registerAll();
  const TinyStudy study;
  const std::vector<std::string> over = {"study.vary=none", "plot.errors.x=time",
                                         "plot.errors.y=robot_position_m, target_position_m"};
  auto set = over;
  set.emplace_back("study.time_bins=6");
  const Plan plan = study.plan(set);
  execute(plan, study.out("out"), {});
  const Outcome outcome = collect(plan, {study.out("out")});
  ASSERT_TRUE(outcome.complete());
  const results::Figure figure = figureOf(plan, outcome, plan.spec.plots.at(0));
  ASSERT_EQ(figure.panels.size(), 2u);
  ASSERT_EQ(figure.panels[0].series.size(), 4u);  // two bands, and two lines over them
  const results::Series& line = figure.panels[0].series[2];
  EXPECT_EQ(line.title, "joint");
  ASSERT_EQ(line.x.size(), 6u);
  EXPECT_NEAR(line.x[0], 0.2, 1e-9);  // of 2.4 s
  // The mean over the parts is the mean over the run, but for the one row more in the last.
  double sum = 0;
  for (const double y : line.y) sum += y / 6;
  EXPECT_NEAR(sum, outcome.summary(plan, 0, *metricByName("robot_mean_m")).mean, 0.1 * sum);
  EXPECT_THROW((void)study.spec(over), core::Error);  // the study keeps no curves
}
}  // namespace slamot::study::test
