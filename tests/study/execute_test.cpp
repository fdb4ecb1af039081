#include <slamot/core/Error.h>
#include <slamot/core/FilterRegistry.h>
#include <slamot/eval/Recorder.h>
#include <slamot/filters/registerAll.h>
#include <slamot/sim/World.h>
#include <slamot/study/Metrics.h>

#include "tinyStudy.h"

namespace slamot::study::test
{
namespace
{
/// A filter that stays at the start, and cannot do with seed 3.
class Moody : public core::Filter
{
 public:
  Moody(core::Params&, const core::FilterContext& context) : seed_(context.seed)
  {
    estimate_.robot = context.starts.robotPose();
  }
  core::Update process(const core::Step& step) override
  {
    if (seed_ == 3)
      throw core::Error(core::ExitStatus::kNonsense, "moody", "dislikes the number 3");
    estimate_.time = step.time;
    return {estimate_, {}, {}};
  }
  [[nodiscard]] core::Estimate estimate() const override { return estimate_; }

 private:
  std::uint64_t seed_;
  core::Estimate estimate_;
};
SLAMOT_REGISTER_FILTER("moody", Moody)

class Execute : public ::testing::Test
{
 protected:
  Execute() { filters::registerAll(); }

  ExecuteResult run(const Plan& plan, const std::string& name,
                    const ExecuteOptions& options = {}) const
  {
    return execute(plan, study.out(name), options);
  }

  TinyStudy study;
};
}  // namespace

TEST_F(Execute, RunEqualsTheFilterOnTheWorldByHand)
{
  const Plan plan = study.plan({"vary.landmarks.values=8"});
  const RunRecord record = executeRun(plan, {0, 7});
  core::Config world = core::Config::parse(TinyStudy::kWorld, "world.ini");
  world.set("world.landmarks=8");
  sim::World source(sim::Scenario::from(world), 7);
  core::Config config = core::Config::parse(TinyStudy::kFilter, "filter.ini");
  config.set("rbpf-slamot.particles=6");
  const auto filter =
      core::FilterRegistry::instance().make("rbpf-slamot", config, {source.starts(), 7, 1, {}});
  eval::Recorder recorder(*filter);
  core::run(source, *filter, {&recorder});
  const auto e = eval::evaluate(recorder.record(), source.truth(), {});
  ASSERT_TRUE(record.error.empty()) << record.error;
  EXPECT_EQ(record.metrics[*metricByName("robot_mean_m")], e.robot.all.positionMean);
  EXPECT_EQ(record.metrics[*metricByName("target_mean_m")], e.trueTargets.at(0).all.positionMean);
  EXPECT_EQ(record.metrics[*metricByName("target_nees")], e.trueTargets.at(0).all.neesMean);
  EXPECT_EQ(record.metrics[*metricByName("landmarks_rmse_m")], e.landmarks.rmse);
}

TEST_F(Execute, TablesDoNotDependOnThreadsOrShards)
{
  const Plan plan = study.plan();
  run(plan, "one");
  const std::string expected = texts(plan, {study.out("one")});
  ExecuteOptions threads;
  threads.threads = 3;
  EXPECT_EQ(run(plan, "threads", threads).made, plan.runs.size());
  EXPECT_EQ(texts(plan, {study.out("threads")}), expected);
  std::size_t made = 0;
  for (const int shard : {1, 2, 3})
  {
    ExecuteOptions options;
    options.shard = shard;
    options.shards = 3;
    made += run(plan, "shards/" + std::to_string(shard), options).made;
  }
  EXPECT_EQ(made, plan.runs.size());
  const auto folders = recordFolders(study.out("shards"));
  EXPECT_EQ(folders.size(), 3u);
  EXPECT_EQ(texts(plan, folders), expected);
}

TEST_F(Execute, StoppedStudyGoesOnWhereItWas)
{
  const Plan plan = study.plan();
  run(plan, "whole");
  std::atomic<bool> stop{false};
  ExecuteOptions options;
  options.stop = &stop;
  options.onProgress = [&](std::size_t done, std::size_t, std::size_t) { stop = done == 5; };
  const ExecuteResult first = run(plan, "parts", options);
  EXPECT_TRUE(first.interrupted);
  EXPECT_EQ(first.made, 5u);
  const Outcome part = collect(plan, {study.out("parts")});
  EXPECT_EQ(part.missing, plan.runs.size() - 5);
  EXPECT_NE(tableMarkdown(plan, part).find("**Incomplete: 11 of 16 runs are missing.**"),
            std::string::npos);
  const ExecuteResult second = run(plan, "parts");
  EXPECT_FALSE(second.interrupted);
  EXPECT_EQ(second.found, 5u);
  EXPECT_EQ(second.made, plan.runs.size() - 5);
  EXPECT_EQ(texts(plan, {study.out("parts")}), texts(plan, {study.out("whole")}));
  EXPECT_EQ(run(plan, "parts").made, 0u);
}

TEST_F(Execute, StaleAndDamagedRecordsAreNoticedAndMadeAnew)
{
  const Plan plan = study.plan();
  run(plan, "out");
  const std::string expected = texts(plan, {study.out("out")});
  const std::string path = "out/" + plan.recordPath(plan.runs[2]);
  const std::string record = study.folder().read(path);
  study.folder().write(path, record.substr(0, record.size() / 2));
  EXPECT_EQ(collect(plan, {study.out("out")}).stale, 1u);
  EXPECT_EQ(collect(plan, {study.out("out")}).missing, 1u);
  ExecuteResult result = run(plan, "out");
  EXPECT_EQ(result.stale, 1u);
  EXPECT_EQ(result.made, 1u);
  EXPECT_EQ(texts(plan, {study.out("out")}), expected);

  std::string failed = study.folder().read(path);
  failed.replace(failed.find("\"error\": \"\""), 11, "\"error\": \"odd\"");  // of status 0
  study.folder().write(path, failed);
  EXPECT_EQ(collect(plan, {study.out("out")}).stale, 1u);
  EXPECT_EQ(run(plan, "out").made, 1u);

  const Plan other = study.plan({"method.joint.rbpf-slamot.particles=7"});
  EXPECT_EQ(collect(other, {study.out("out")}).stale, 8u);  // the other method's are as before
  result = run(other, "out");
  EXPECT_EQ(result.stale, 8u);
  EXPECT_EQ(result.made, 8u);
  EXPECT_EQ(result.found, 8u);
}

TEST_F(Execute, FailedRunIsRecordedCountedAndTriedAgain)
{
  study.folder().write("moody.ini", "[moody]\n");
  const Plan plan = study.plan({"method.odometry.config=moody.ini"});
  const ExecuteResult result = run(plan, "out");
  EXPECT_EQ(result.made, plan.runs.size());
  EXPECT_EQ(result.failed, 2u);  // seed 3 in both cells
  ASSERT_TRUE(result.firstFailed);
  EXPECT_EQ(result.firstFailed->status, 4);
  const Outcome outcome = collect(plan, {study.out("out")});
  EXPECT_EQ(outcome.failed, 2u);
  EXPECT_EQ(outcome.missing, 0u);
  const std::string page = tableMarkdown(plan, outcome);
  EXPECT_NE(page.find("**2 of 16 runs failed"), std::string::npos) << page;
  EXPECT_NE(page.find("seed 3: moody: dislikes the number 3"), std::string::npos) << page;
  EXPECT_EQ(statistics(outcome.values(plan, plan.groupOf[0][1], 0)).count, 3);
  EXPECT_EQ(statistics(outcome.values(plan, plan.groupOf[0][0], 0)).count, 4);
  EXPECT_EQ(run(plan, "out").made, 2u);
}

TEST_F(Execute, RawlogsAreCellsOfTheirOwn)
{
  const std::string logs = std::string(SLAMOT_SOURCE_DIR) + "/share/datasets/";
  const TinyStudy onLogs("[study]\nmethods = odometry\nseeds = 1\nrawlogs = " + logs +
                         "experiment1.rawlog, " + logs +
                         "post-field.rawlog\n[method.odometry]\nconfig = odometry.ini\n");
  const Plan plan = onLogs.plan();
  ASSERT_EQ(plan.cells.size(), 2u);
  execute(plan, onLogs.out("out"), {});
  const Outcome outcome = collect(plan, {onLogs.out("out")});
  EXPECT_TRUE(outcome.complete());
  const std::string table = tableCsv(plan, outcome);
  EXPECT_EQ(table.rfind("dataset,method,metric", 0), 0u);
  EXPECT_NE(table.find("experiment1,odometry,robot_mean_m,1,"), std::string::npos) << table;
  EXPECT_NE(table.find("post-field,odometry,robot_mean_m,1,"), std::string::npos);
}

TEST_F(Execute, SeveralStudiesAtOnceMakeWhatEachWouldMake)
{
  const Plan plan = study.plan(), other = study.plan({"study.seeds=2", "study.first_seed=9"});
  run(plan, "plan");
  run(other, "other");
  ExecuteOptions options;
  options.threads = 3;
  std::size_t last = 0, all = 0;
  options.onProgress = [&](std::size_t done, std::size_t of, std::size_t)
  { last = done, all = of; };
  const auto results =
      execute({{&plan, study.out("both/plan")}, {&other, study.out("both/other")}}, options);
  ASSERT_EQ(results.size(), 2u);
  EXPECT_EQ(results[0].made, 16u);
  EXPECT_EQ(results[1].made, 8u);
  EXPECT_EQ(last, 24u);
  EXPECT_EQ(all, 24u);
  EXPECT_EQ(texts(plan, {study.out("both/plan")}), texts(plan, {study.out("plan")}));
  EXPECT_EQ(texts(other, {study.out("both/other")}), texts(other, {study.out("other")}));
}

TEST_F(Execute, SeveralStudiesGoForwardTogether)
{
  const Plan plan = study.plan(), other = study.plan({"study.seeds=2", "study.first_seed=9"});
  std::atomic<bool> stop{false};
  ExecuteOptions options;
  options.stop = &stop;
  options.onProgress = [&](std::size_t done, std::size_t of, std::size_t)
  { stop = 2 * done == of; };
  const auto results = execute({{&plan, study.out("a")}, {&other, study.out("b")}}, options);
  EXPECT_TRUE(results[0].interrupted);
  EXPECT_TRUE(results[1].interrupted);
  EXPECT_EQ(results[0].made, 8u);
  EXPECT_EQ(results[1].made, 4u);
}
}  // namespace slamot::study::test
