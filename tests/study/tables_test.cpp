#include <slamot/core/Error.h>
#include <slamot/filters/registerAll.h>
#include <slamot/study/Metrics.h>

#include "tinyStudy.h"

namespace slamot::study::test
{
namespace
{
using Values = std::vector<std::optional<double>>;

eval::StepError stepError(std::size_t row, double x, double heading)
{
  eval::StepError s;
  s.row = row;
  s.error = {x, 0, heading};
  s.headingKnown = true;
  return s;
}

/// A plan of one group, with records made up.
struct MadeUp
{
  explicit MadeUp(const TinyStudy& study)
      : plan(study.plan({"study.vary=none", "vary.landmarks.values=1", "study.seeds=3"}))
  {
    for (const Run& run : plan.runs)
    {
      RunRecord record;
      record.seed = run.seed;
      record.metrics.resize(metrics().size());
      record.metrics[0] = static_cast<double>(run.seed) * (run.group == 0 ? 0.1 : 0.3);
      outcome.records.emplace_back(record);
    }
  }
  Plan plan;
  Outcome outcome;
};

const char* kNoPlot = "[plot.errors]\ny = robot_mean_m\n";

std::string withoutPlot()
{
  std::string text = TinyStudy::kStudy;
  return text.erase(text.find(kNoPlot), std::string(kNoPlot).size());
}
}  // namespace

TEST(PairedRatio, IsThatOfTheMeans)
{
  const auto exact = pairedRatio(Values{2.0, 4.0, 6.0}, Values{1.0, 2.0, 3.0});
  ASSERT_TRUE(exact);
  EXPECT_DOUBLE_EQ(exact->mean, 2.0);
  EXPECT_NEAR(exact->halfWidth95, 0.0, 1e-12);
  // a = (1, 3), b = (1, 1): r = 2, residuals (-1, 1), std sqrt 2, half = t(0.975, 1) sqrt 2 /
  // sqrt 2.
  const auto pair = pairedRatio(Values{1.0, 3.0}, Values{1.0, 1.0});
  EXPECT_DOUBLE_EQ(pair->mean, 2.0);
  EXPECT_NEAR(pair->halfWidth95, 12.7062, 1e-3);
}

TEST(PairedRatio, LeavesOutSeedsThatOneHasNot)
{
  const auto ratio = pairedRatio(Values{2.0, {}, 6.0, 9.0}, Values{1.0, 5.0, 3.0, {}});
  EXPECT_DOUBLE_EQ(ratio->mean, 2.0);
  EXPECT_EQ(ratio->count, 2);
  EXPECT_FALSE(pairedRatio(Values{1.0}, Values{0.0}));
  EXPECT_FALSE(pairedRatio(Values{{}}, Values{1.0}));
}

TEST(Metrics, QuartersAreOfTheRun)
{
  eval::Record record;
  record.rows.resize(8);
  eval::Evaluation e;
  eval::TargetEvaluation target;
  for (std::size_t row = 0; row < 8; ++row)
    target.steps.push_back(stepError(row, static_cast<double>(row), row % 2 == 0 ? -0.1 : 0.3));
  e.trueTargets = {target};
  const auto values = measure(record, e);
  EXPECT_DOUBLE_EQ(*values[*metricByName("target_early_mean_m")], 0.5);  // rows 0 and 1
  EXPECT_DOUBLE_EQ(*values[*metricByName("target_late_mean_m")], 6.5);   // rows 6 and 7
  EXPECT_DOUBLE_EQ(*values[*metricByName("target_heading_mean_rad")], 0.2);
  EXPECT_FALSE(values[*metricByName("robot_mean_m")]);
  EXPECT_FALSE(values[*metricByName("pairs_wrong")]);
}

TEST(Metrics, MedianNeesWithstandsACollapse)
{
  eval::Record record;
  record.rows.resize(3);
  eval::Evaluation e;
  for (const double nees : {1.0, 1e12, 2.0})
  {
    e.robot.steps.push_back(stepError(0, 0, 0));
    e.robot.steps.back().nees = nees;
  }
  EXPECT_DOUBLE_EQ(*measure(record, e)[*metricByName("robot_nees_median")], 2.0);
}

TEST(Metrics, OfTargetsAreTheMeanOverTargets)
{
  eval::Record record;
  record.rows.resize(1);
  eval::Evaluation e;
  e.trueTargets.resize(3);
  e.trueTargets[0].all.positionMean = 1.0;
  e.trueTargets[1].all.positionMean = 2.0;  // the third was never tracked
  e.trueTargets[2].trackedFraction = 0.0;
  EXPECT_DOUBLE_EQ(*measure(record, e)[*metricByName("target_mean_m")], 1.5);
}

TEST(Metrics, OfAxesAreRootMeanSquares)
{
  eval::Record record;
  record.rows.resize(2);
  eval::Evaluation e;
  e.trueTargets.resize(1);
  for (const double x : {3.0, 1.0})
  {
    e.trueTargets[0].steps.push_back(stepError(0, 0, 0));
    e.trueTargets[0].steps.back().error = {x, -2, 0};
  }
  e.trueTargets[0].velocityRmse = Vector2(0.5, 0.25);
  const auto values = measure(record, e);
  EXPECT_DOUBLE_EQ(*values[*metricByName("target_x_rmse_m")], std::sqrt(5.0));
  EXPECT_DOUBLE_EQ(*values[*metricByName("target_y_rmse_m")], 2);
  EXPECT_DOUBLE_EQ(*values[*metricByName("target_vx_rmse_mps")], 0.5);
  EXPECT_DOUBLE_EQ(*values[*metricByName("target_vy_rmse_mps")], 0.25);
}

TEST(Metrics, OfParticlesAreOverTheStepsThatWeighThem)
{
  eval::Record record;
  record.steps.resize(5);
  for (const std::size_t step : {1, 2, 3}) record.steps[step].ess = 10.0 * double(step);
  record.steps[1].largestWeight = 0.995;
  record.steps[2].largestWeight = 0.98;
  record.steps[2].resampled = true;
  const auto values = measure(record, {});
  EXPECT_DOUBLE_EQ(*values[*metricByName("ess_mean")], 20);
  EXPECT_DOUBLE_EQ(*values[*metricByName("degenerate_share")], 0.5);
  EXPECT_DOUBLE_EQ(*values[*metricByName("resampled_share")], 1.0 / 3);
  EXPECT_FALSE(measure(eval::Record{}, {})[*metricByName("ess_mean")]);
}

TEST(Tables, ShowMeansIntervalsRatiosAndPublishedFigures)
{
  filters::registerAll();
  const TinyStudy study(withoutPlot());
  const MadeUp m(study);
  const std::string page = tableMarkdown(m.plan, m.outcome);
  // 0.1, 0.2, 0.3: std 0.1, half width 4.3027 * 0.1 / sqrt 3.
  EXPECT_NE(page.find("| joint | 0.2000 ± 0.2484 (0.1000) | - |"), std::string::npos) << page;
  EXPECT_NE(page.find("| Odometry | 0.6000 ± 0.7452 (0.3000) | - |"), std::string::npos) << page;
  EXPECT_NE(page.find("| Odometry | 3.000 ± 0.000 |"), std::string::npos) << page;
  EXPECT_NE(page.find("| *Print* | *0.01 (0.002)* |"), std::string::npos) << page;
  EXPECT_EQ(page.find("ncomplete"), std::string::npos);
  const std::string csv = tableCsv(m.plan, m.outcome);
  EXPECT_EQ(csv.rfind("method,metric,runs,mean,std,half95,ratio,ratio_half95\n", 0), 0u);
  EXPECT_NE(csv.find("odometry,robot_mean_m,3,0.6"), std::string::npos) << csv;
  const std::string runs = runsCsv(m.plan, m.outcome);
  EXPECT_NE(runs.find("joint,2,,0.2,"), std::string::npos) << runs;
}

TEST(Tables, PlotIsACurveForEachMethodOverTheAxis)
{
  filters::registerAll();
  const TinyStudy study;
  const Plan plan = study.plan({"study.seeds=2"});
  execute(plan, study.out("out"), {});
  const Outcome outcome = collect(plan, {study.out("out")});
  const results::Figure figure = figureOf(plan, outcome, plan.spec.plots.at(0));
  ASSERT_EQ(figure.panels.size(), 1u);
  ASSERT_EQ(figure.panels[0].series.size(), 2u);
  const results::Series& joint = figure.panels[0].series[0];
  EXPECT_EQ(joint.title, "joint");
  EXPECT_EQ(joint.x, (std::vector<double>{3, 8}));
  const auto s =
      statistics(outcome.values(plan, plan.groupOf[1][0], *metricByName("robot_mean_m")));
  EXPECT_DOUBLE_EQ(joint.y.at(1), s.mean);
  EXPECT_DOUBLE_EQ(joint.high.at(1), s.mean + s.halfWidth95);
  saveResults(study.out("out"), plan, outcome);
  EXPECT_EQ(study.folder().read("out/errors.png").substr(1, 3), "PNG");
  EXPECT_NE(study.folder().read("out/errors.svg").find("<svg"), std::string::npos);
  EXPECT_EQ(study.folder().read("out/table.md"), tableMarkdown(plan, outcome));
}

TEST(Tables, PublishedFiguresStandUnderTheRowThatTheyAreOf)
{
  filters::registerAll();
  std::string text = TinyStudy::kStudy;
  text +=
      "[published.placed]\nlabel = Placed\nmethod = odometry\nlandmarks = 8\nrobot_mean_m = "
      "0.5\n[published.elsewhere]\nmethod = odometry\nlandmarks = 9\nrobot_mean_m = 0.6\n";
  const TinyStudy study(text);
  const Plan plan = study.plan({"study.seeds=1"});
  const Outcome outcome = collect(plan, {});
  const TableText table = tableText(plan, outcome, plan.spec.tables[0]);
  ASSERT_EQ(table.rows.size(), 6u);  // four of ours; the cell with 9 landmarks is not there
  EXPECT_FALSE(table.rows[3].isPublished);
  EXPECT_EQ(table.rows[3].fields, (std::vector<std::string>{"8", "Odometry", "-", "-"}));
  EXPECT_TRUE(table.rows[4].isPublished);
  EXPECT_EQ(table.rows[4].fields, (std::vector<std::string>{"8", "Placed", "0.5", ""}));
  EXPECT_EQ(table.rows[5].fields, (std::vector<std::string>{"", "Print", "0.01 (0.002)", ""}));
  EXPECT_EQ(tableText(plan, outcome, plan.spec.tables[1]).rows.size(), 2u);  // ratios: none
}

TEST(Tables, OnlyTheMethodsThatATableNamesAreInIt)
{
  filters::registerAll();
  const TinyStudy study;
  const Plan plan = study.plan({"study.seeds=1", "table.errors.methods=odometry"});
  const TableText table = tableText(plan, collect(plan, {}), plan.spec.tables[0]);
  ASSERT_EQ(table.rows.size(), 3u);
  for (std::size_t i : {0u, 1u}) EXPECT_EQ(table.rows[i].fields[1], "Odometry");
}

TEST(Plots, ShowOnlyTheMethodsAndCellsThatTheyName)
{
  filters::registerAll();
  std::string text = TinyStudy::kStudy;
  const std::string axis = "[vary.landmarks]\n";
  text.insert(text.find(axis),
              "[vary.seen]\nlabel = range\nkeys = landmark_sensor.range_max_m\n"
              "values = 5, 8\n");
  const TinyStudy study(text);
  const std::vector<std::string> set = {"study.seeds=1", "study.vary=landmarks, seen"};
  const auto curvesOf = [&](const std::vector<std::string>& more)
  {
    auto all = set;
    all.insert(all.end(), more.begin(), more.end());
    const Plan plan = study.plan(all);
    execute(plan, study.out("out"), {});
    std::vector<std::string> titles;
    const auto figure = figureOf(plan, collect(plan, {study.out("out")}), plan.spec.plots[0]);
    for (const auto& s : figure.panels[0].series) titles.push_back(s.title);
    return titles;
  };
  using Titles = std::vector<std::string>;
  EXPECT_EQ(curvesOf({}),
            (Titles{"joint, range 5", "joint, range 8", "Odometry, range 5", "Odometry, range 8"}));
  EXPECT_EQ(curvesOf({"plot.errors.seen=8"}), (Titles{"joint", "Odometry"}));
  EXPECT_EQ(curvesOf({"plot.errors.seen=8", "plot.errors.methods=joint"}), Titles{"joint"});
  auto wrong = set;
  wrong.emplace_back("plot.errors.seen=9");
  EXPECT_THROW((void)study.spec(wrong), core::Error);
  wrong.back() = "plot.errors.methods=nobody";
  EXPECT_THROW((void)study.spec(wrong), core::Error);
}
}  // namespace slamot::study::test
