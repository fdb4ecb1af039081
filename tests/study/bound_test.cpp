#include <slamot/core/Error.h>
#include <slamot/filters/registerAll.h>
#include <slamot/math/random.h>
#include <slamot/sim/posteriorBound.h>
#include <slamot/study/Metrics.h>

#include <atomic>
#include <thread>

#include "BoundCache.h"
#include "tinyStudy.h"

namespace slamot::study::test
{
namespace
{
using Values = std::vector<std::optional<double>>;

std::optional<double> value(const RunRecord& record, const std::string& metric)
{
  EXPECT_EQ(record.error, "");
  return record.metrics.at(*metricByName(metric));
}

class BoundColumns : public ::testing::Test
{
 protected:
  BoundColumns() { filters::registerAll(); }
  /// The first method's run with 8 landmarks and seed 7.
  [[nodiscard]] RunRecord run(std::vector<std::string> set = {}) const
  {
    set.push_back("vary.landmarks.values=8");
    return executeRun(study.plan(set), {0, 7});
  }
  TinyStudy study;
};

/// A study of the EKF that knows all identities, on a shipped scenario.
Plan ekfStudy(const slamot::test::TemporaryFolder& folder, const std::string& more,
              const std::string& ofMethod = "")
{
  const std::string configs = SLAMOT_SOURCE_DIR "/config-ini/";
  folder.write("study.ini",
               "[study]\nscenario = " + configs + "sim.experiment1.ini\nmethods = ekf\n" + more +
                   "[method.ekf]\nconfig = " + configs + "ekf-slamot.experiment1.ini\n" + ofMethod);
  return Plan(StudySpec::load(folder.file("study.ini")));
}
}  // namespace

TEST_F(BoundColumns, AreTheWorldsBound)
{
  core::Config config = core::Config::parse(TinyStudy::kWorld, "world.ini");
  config.set("world.landmarks=8");
  const auto bound = sim::posteriorBound(sim::Scenario::from(config), 7);
  ASSERT_TRUE(bound);
  const RunRecord record = run();
  EXPECT_EQ(value(record, "robot_pcrb_m"), bound->robots[0].position.bound);
  EXPECT_EQ(value(record, "robot_heading_pcrb_rad"), bound->robots[0].heading.bound);
  EXPECT_EQ(value(record, "landmarks_pcrb_m"), bound->map->bound);
  EXPECT_EQ(value(record, "target_pcrb_m"), bound->targets.at(1).bound);
  EXPECT_DOUBLE_EQ(*value(record, "robot_rmse_over_pcrb"),
                   *value(record, "robot_rmse_m") / bound->robots[0].position.bound);
  EXPECT_DOUBLE_EQ(*value(record, "landmarks_rmse_over_pcrb"),
                   *value(record, "landmarks_rmse_m") / bound->map->bound);
  EXPECT_EQ(value(record, "robot_efficient_rmse_m"), bound->robots[0].position.efficient);
  EXPECT_EQ(value(record, "landmarks_efficient_rmse_m"), bound->map->efficient);
  EXPECT_EQ(value(record, "target_efficient_rmse_m"), bound->targets.at(1).efficient);
  EXPECT_DOUBLE_EQ(*value(record, "target_rmse_over_efficient"),
                   *value(record, "target_rmse_m") / bound->targets.at(1).efficient);
}

TEST_F(BoundColumns, AreTheSameForAllMethods)
{
  const Plan plan = study.plan({"vary.landmarks.values=8"});
  EXPECT_EQ(value(executeRun(plan, {0, 3}), "robot_pcrb_m"),
            value(executeRun(plan, {1, 3}), "robot_pcrb_m"));
}

TEST_F(BoundColumns, AreAbsentWhereErrorsAreTakenOtherwise)
{
  EXPECT_TRUE(value(run({"study.align=none"}), "robot_pcrb_m"));
  EXPECT_TRUE(value(run({"study.align=first-pose"}), "robot_pcrb_m"));  // the start is exact
  EXPECT_FALSE(value(run({"study.align=rigid"}), "robot_pcrb_m"));
  EXPECT_FALSE(
      value(run({"study.align=first-pose", "scenario.robot.start_std_x_m=0.1"}), "robot_pcrb_m"));
  EXPECT_FALSE(value(run({"study.bound=false"}), "robot_rmse_over_pcrb"));
  EXPECT_FALSE(value(run({"method.joint.start.robot_x_m=1"}), "robot_pcrb_m"));
}

TEST_F(BoundColumns, OfMapsAreForIdentitiesOnly)
{
  EXPECT_FALSE(value(run({"method.joint.rbpf-slamot.association=nn"}), "landmarks_rmse_over_pcrb"));
}

TEST(BoundCache, ComputesEachWorldOnce)
{
  std::atomic<int> computed{0};
  BoundCache cache;
  const auto ask = [&](const char* world)
  {
    Trial trial;
    trial.world = world;
    trial.bound = [&]
    {
      ++computed;
      return std::optional<BoundFigures>(BoundFigures{BoundFigures::Figure{1.5, 1}, {}, {}, {}});
    };
    EXPECT_EQ(cache.of(trial)->robotPosition->bound, 1.5);
  };
  std::vector<std::thread> threads;
  for (int i = 0; i < 8; ++i) threads.emplace_back([&, i] { ask(i % 2 == 0 ? "a" : "b"); });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(computed, 2);
  EXPECT_FALSE(cache.of(Trial{}));
}

TEST(BoundCache, PassesOnWhatWentWrong)
{
  BoundCache cache;
  Trial trial;
  trial.bound = []() -> std::optional<BoundFigures>
  { throw core::Error(core::ExitStatus::kNonsense, "world", "is none"); };
  EXPECT_THROW((void)cache.of(trial), core::Error);
  EXPECT_THROW((void)cache.of(trial), core::Error);
}

TEST(PairedRootRatio, IsThatOfMeanSquares)
{
  const auto exact = pairedRootRatio(Values{2.0, 4.0, {}, 6.0}, Values{1.0, 2.0, 9.0, 3.0});
  ASSERT_TRUE(exact);
  EXPECT_DOUBLE_EQ(exact->mean, 2);
  EXPECT_NEAR(exact->halfWidth95, 0, 1e-12);
  EXPECT_EQ(exact->count, 3);
  // Squares (1, 7) by (1, 1): q = 4, residuals (-3, 3); half 12.7062 * sqrt 18 / sqrt 2 = 38.12
  // of q, and of its root 38.12 / 4.
  const auto pair = pairedRootRatio(Values{1.0, std::sqrt(7.0)}, Values{1.0, 1.0});
  EXPECT_DOUBLE_EQ(pair->mean, 2);
  EXPECT_NEAR(pair->halfWidth95, 38.1186 / 4, 1e-3);
  EXPECT_FALSE(pairedRootRatio(Values{1.0}, Values{0.0}));
}

// How often the intervals of 40 seeds hold the truth, where a run's error scatters by half its mean
// as on the loop: a table's 95% must not be far from that.
TEST(PairedRatio, IntervalsHoldTheTruthAboutAsOftenAsTheySay)
{
  math::RandomStream random{5};
  int means = 0, roots = 0;
  constexpr int kTrials = 1000;
  for (int trial = 0; trial < kTrials; ++trial)
  {
    Values a, b, bound;
    for (int i = 0; i < 40; ++i)
    {
      const double common = 0.4 * random.normal();  // of a seed, to both methods
      a.emplace_back(std::exp(common + 0.25 * random.normal()));
      b.emplace_back(std::exp(common + 0.25 * random.normal()));
      bound.emplace_back(std::exp(0.4 * 0.4 + 0.25 * 0.25));  // root of the mean of a²
    }
    const auto ratio = *pairedRatio(a, b), root = *pairedRootRatio(a, bound);
    means += std::abs(ratio.mean - 1) <= ratio.halfWidth95;
    roots += std::abs(root.mean - 1) <= root.halfWidth95;
  }
  EXPECT_GT(means, 0.92 * kTrials);
  EXPECT_LT(means, 0.975 * kTrials);
  EXPECT_GT(roots, 0.88 * kTrials);
}

TEST(Outcome, RatiosToABoundAreOfMeanSquares)
{
  filters::registerAll();
  const TinyStudy study;
  const Plan plan = study.plan(
      {"vary.landmarks.values=8", "study.seeds=3", "table.errors.columns=robot_rmse_over_pcrb"});
  Outcome outcome;
  for (const study::Run& run : plan.runs)
  {
    RunRecord record;
    record.seed = run.seed;
    record.metrics.resize(metrics().size());
    const double rmse = run.group == 0 ? 1.0 : 2.0 * static_cast<double>(run.seed);
    record.metrics[*metricByName("robot_rmse_m")] = rmse;
    record.metrics[*metricByName("robot_pcrb_m")] = 0.5;
    record.metrics[*metricByName("robot_rmse_over_pcrb")] = rmse / 0.5;
    outcome.records.emplace_back(record);
  }
  const std::size_t over = *metricByName("robot_rmse_over_pcrb");
  EXPECT_DOUBLE_EQ(outcome.summary(plan, 0, over).mean, 2);
  // 2, 4, 6 by 0.5, where the mean of the ratios would be 8.
  EXPECT_DOUBLE_EQ(outcome.summary(plan, 1, over).mean, std::sqrt(56 / 3.0) / 0.5);
  EXPECT_DOUBLE_EQ(outcome.ratio(plan, 1, 0, over)->mean, std::sqrt(56 / 3.0));
  // A run without the ratio counts in neither sum.
  outcome.records[plan.runAt(1, 2)]->metrics[over].reset();
  EXPECT_DOUBLE_EQ(outcome.summary(plan, 1, over).mean, std::sqrt(20 / 2.0) / 0.5);
  EXPECT_NE(tableMarkdown(plan, outcome).find("roots of ratios of mean squares"),
            std::string::npos);
}

// With identities known and noises that a linear filter can take, the EKF is near the bound, never
// far below it: robot, map and target, over 40 seeds.  Errors of a run are correlated over time, so
// that a mean square over 40 runs scatters by a fifth, its root by a tenth.
TEST(PosteriorBound, IsWhatTheEkfThatKnowsIdentitiesReaches)
{
  filters::registerAll();
  const slamot::test::TemporaryFolder folder;
  const Plan plan = ekfStudy(folder, "seeds = 40\n[scenario]\nworld.landmarks = 5\n");
  ExecuteOptions options;
  options.threads = 2;
  execute(plan, folder.file("out"), options);
  const Outcome outcome = collect(plan, {folder.file("out")});
  for (const char* name : {"robot_rmse_over_pcrb", "robot_heading_rmse_over_pcrb",
                           "landmarks_rmse_over_pcrb", "target_rmse_over_pcrb"})
  {
    const auto ratio = outcome.summary(plan, 0, *metricByName(name));
    EXPECT_EQ(ratio.count, 40) << name;
    EXPECT_GT(ratio.mean, 0.85) << name;
    EXPECT_LT(ratio.mean, 1.2) << name;
    EXPECT_GT(ratio.mean + ratio.halfWidth95, 1) << name;
  }
}

// With a hundredth of the noises nothing bends any more: run by run, the EKF makes the very errors
// of the efficient filter.
TEST(EfficientFilter, IsTheEkfWhereNoisesAreSmall)
{
  filters::registerAll();
  const slamot::test::TemporaryFolder folder;
  const Plan plan = ekfStudy(
      folder,
      "seeds = 5\n[scenario]\nrobot.v_std_mps = 0.004\nrobot.omega_std_radps = 0.000872\n"
      "target.v_std_mps = 0.008\ntarget.omega_std_radps = 0.006\ntarget.start_std_x_m = 0.001\n"
      "target.start_std_y_m = 0.001\ntarget.start_std_theta_rad = 0.001\n"
      "landmark_sensor.range_std_m = 0.001\nlandmark_sensor.bearing_std_rad = 0.00008\n"
      "target_sensor.range_std_m = 0.001\ntarget_sensor.bearing_std_rad = 0.00008\n",
      "ekf-slamot.target_speed_noise_mps = 0.008\n"
      "ekf-slamot.target_turn_rate_noise_deg_per_s = 0.343775\n");
  for (const study::Run& run : plan.runs)
  {
    const RunRecord record = executeRun(plan, run);
    for (const char* name : {"robot_rmse_over_efficient", "robot_heading_rmse_over_efficient",
                             "landmarks_rmse_over_efficient", "target_rmse_over_efficient"})
      EXPECT_NEAR(*value(record, name), 1, 0.005) << name << ", seed " << run.seed;
  }
}
}  // namespace slamot::study::test
