#include <gtest/gtest.h>
#include <slamot/core/Error.h>
#include <slamot/results/RecordFiles.h>
#include <slamot/results/ResultFolder.h>
#include <slamot/results/StepTimer.h>

#include <clocale>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>

#include "TemporaryFolder.h"

namespace slamot::results
{
namespace
{
using test::TemporaryFolder;

eval::Record smallRecord()
{
  eval::Record r;
  r.hasMap = true;
  r.complete = true;
  r.observations = 4;
  r.particles = 10;
  for (int i = 0; i < 3; ++i)
  {
    eval::RobotRow row;
    row.time = 1e9 + 0.1 * i;
    row.robot.mean = {0.1 * i, 1.0 / 3, -0.2 * i};
    row.robot.cov << 0.02, 0.001, 0.002, 0.001, 0.03, 0.003, 0.002, 0.003, 0.04;
    row.odometry = {0.2 * i, 0.1, 0.3 * i};
    row.scan = i == 2;
    r.rows.push_back(row);
  }
  for (int i = 1; i < 3; ++i)
  {
    eval::StepRow step;
    step.time = r.rows[i].time;
    step.scan = i == 2;
    if (i == 2) step.ess = 4.5;
    step.resampled = i == 2;
    r.steps.push_back(step);
  }
  eval::TargetTrack named{3, "robot", true, {{1, r.rows[1].robot, {1, -1}, 1e9}}};
  eval::TargetTrack unnamed{0, "a,b", false, {{2, r.rows[2].robot, {0.5, 0}, 1e9 + 0.2}}};
  r.targets = {named, unnamed};
  r.landmarks = {{7, {{1, 2}, 0.01 * Matrix2::Identity()}, 5}};
  r.pairings = {{1e9 + 0.2, {false, 0, core::Pairing::Outcome::kNew, 7}, 7},
                {1e9 + 0.2, {true, 0, core::Pairing::Outcome::kRejected, -1}, -1}};
  return r;
}

RunInfo info()
{
  return {"dead-reckoning", "logs/x.rawlog", 5, "[run]\nmethod = dead-reckoning\n"};
}

void write(const std::string& path, const eval::Record& record)
{
  writeResult(path, info(), record, eval::evaluate(record, {}, {}), {}, {});
}

nlohmann::json summaryOf(const eval::Record& record, const eval::Truth& truth)
{
  return nlohmann::json::parse(summaryJson(info(), record, eval::evaluate(record, truth, {}), {}));
}

std::vector<std::string> keysOf(const nlohmann::json& object)
{
  std::vector<std::string> out;
  for (const auto& [key, _] : object.items()) out.push_back(key);
  return out;  // sorted
}
}  // namespace

TEST(ResultFolder, HoldsTheFilesOfTheInterface)
{
  TemporaryFolder folder;
  write(folder.file("out"), smallRecord());
  for (const char* name : {"summary.json", "robot.tum", "robot.csv", "target_3.tum", "target_3.csv",
                           "target_0.tum", "target_0.csv", "landmarks.csv", "config.ini"})
    EXPECT_FALSE(folder.read(std::string("out/") + name).empty()) << name;
  EXPECT_EQ(folder.read("out/robot.csv").substr(0, 36), "t,x,y,theta,cxx,cxy,cxt,cyy,cyt,ctt\n");
  EXPECT_EQ(folder.read("out/landmarks.csv"),
            "id,x,y,cxx,cxy,cyy,sightings\n7,1,2,0.01,0,0.01,5\n");
  EXPECT_EQ(folder.read("out/config.ini"), info().config);
}

TEST(ResultFolder, LeavesNothingBesideIt)
{
  TemporaryFolder folder;
  write(folder.file("a/b/out/"), smallRecord());
  int entries = 0;
  for ([[maybe_unused]] const auto& e : std::filesystem::directory_iterator(folder.file("a/b")))
    ++entries;
  EXPECT_EQ(entries, 1);
}

TEST(ResultFolder, ReplacesAnOlderResultWhole)
{
  TemporaryFolder folder;
  write(folder.file("out"), smallRecord());
  eval::Record record = smallRecord();
  record.targets.clear();
  write(folder.file("out"), record);
  EXPECT_FALSE(std::filesystem::exists(folder.file("out/target_3.csv")));
}

TEST(ResultFolder, DoesNotTouchWhatIsNoResult)
{
  TemporaryFolder folder;
  folder.write("out/thesis.tex", "years");
  folder.write("file", "x");
  EXPECT_THROW(write(folder.file("out"), smallRecord()), core::Error);
  EXPECT_THROW(write(folder.file("file"), smallRecord()), core::Error);
  EXPECT_EQ(folder.read("out/thesis.tex"), "years");
}

TEST(ResultFolder, KeepsTheOldResultIfWritingFails)
{
  TemporaryFolder folder;
  write(folder.file("out"), smallRecord());
  eval::Record bad = smallRecord();
  bad.rows[1].robot.cov(0, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(write(folder.file("out"), bad), core::Error);
  EXPECT_FALSE(folder.read("out/summary.json").empty());
  EXPECT_EQ(folder.read("out/robot.csv").find("nan"), std::string::npos);
}

TEST(ResultFolder, KeepsTheNumbersIfPicturesFail)
{
  TemporaryFolder folder;
  const eval::Record record = smallRecord();
  const auto noPictures = [](const std::string&) { throw std::runtime_error("no gnuplot"); };
  EXPECT_THROW(writeResult(folder.file("out"), info(), record, eval::evaluate(record, {}, {}), {},
                           noPictures),
               std::runtime_error);
  EXPECT_FALSE(folder.read("out/summary.json").empty());
}

TEST(Record, ReadsBackAsItWasWritten)
{
  TemporaryFolder folder;
  const eval::Record a = smallRecord();
  write(folder.file("out"), a);
  const eval::Record b = loadRecord(folder.file("out"));
  ASSERT_EQ(b.rows.size(), a.rows.size());
  for (std::size_t i = 0; i < a.rows.size(); ++i)
  {
    EXPECT_EQ(b.rows[i].time, a.rows[i].time);
    EXPECT_EQ(b.rows[i].robot.mean, a.rows[i].robot.mean);
    EXPECT_EQ(b.rows[i].robot.cov, a.rows[i].robot.cov);
    EXPECT_EQ(b.rows[i].scan, a.rows[i].scan);
    EXPECT_NEAR(b.rows[i].odometry.x, a.rows[i].odometry.x, 1e-9);
    EXPECT_NEAR(b.rows[i].odometry.phi, a.rows[i].odometry.phi, 1e-8);
  }
  ASSERT_EQ(b.targets.size(), 2u);
  EXPECT_EQ(b.targets[0].id, 3);
  EXPECT_TRUE(b.targets[0].identified);
  EXPECT_EQ(b.targets[0].rows[0].row, 1u);
  EXPECT_EQ(b.targets[0].rows[0].lastSeen, 1e9);
  EXPECT_EQ(b.targets[1].label, "a_b");
  ASSERT_EQ(b.landmarks.size(), 1u);
  EXPECT_EQ(b.landmarks[0].id, 7);
  EXPECT_TRUE(b.landmarksIdentified());
  ASSERT_EQ(b.pairings.size(), 2u);
  EXPECT_TRUE(b.pairings[1].pairing.isBlob);
  EXPECT_EQ(b.steps[1].ess, 4.5);
  EXPECT_FALSE(b.steps[0].ess);
  EXPECT_TRUE(b.hasMap && b.complete);
  EXPECT_EQ(b.particles, 10);
}

TEST(Record, HasTheFinalPathInAFolderOfItsOwnIfThereIsOne)
{
  TemporaryFolder folder;
  eval::Record a = smallRecord();
  write(folder.file("out"), a);
  EXPECT_FALSE(std::filesystem::exists(folder.file("out/path")));
  EXPECT_TRUE(loadRecord(folder.file("out")).path.empty());
  a.path.poses = {{1e9 + 0.1, {1, -2, 3}, true}, {1e9 + 0.2, {4, 5, -3}, true}};
  write(folder.file("out"), a);
  const eval::Record b = loadRecord(folder.file("out"));
  ASSERT_EQ(b.path.poses.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i)
  {
    EXPECT_NEAR(b.path.poses[i].time, a.path.poses[i].time, 2e-7);
    EXPECT_NEAR(b.path.poses[i].pose.x, a.path.poses[i].pose.x, 1e-9);
    EXPECT_NEAR(b.path.poses[i].pose.y, a.path.poses[i].pose.y, 1e-9);
    EXPECT_NEAR(b.path.poses[i].pose.phi, a.path.poses[i].pose.phi, 1e-8);
  }
  EXPECT_EQ(b.rows.size(), a.rows.size()) << "robot.tum and robot.csv are of the estimates";
  folder.write("out/path/robot.tum", "1 2 three\n");
  EXPECT_THROW((void)loadRecord(folder.file("out")), core::Error);
}

TEST(Record, OfAFolderWithoutOdometryTellsNone)
{
  TemporaryFolder folder;
  write(folder.file("out"), smallRecord());
  EXPECT_TRUE(loadRecord(folder.file("out")).hasOdometry);
  folder.write("out/odometry.tum", "1000000000.1 0 0 0 0 0 0 1\n");
  EXPECT_THROW((void)loadRecord(folder.file("out")), core::Error);
  std::filesystem::remove(folder.file("out/odometry.tum"));
  EXPECT_FALSE(loadRecord(folder.file("out")).hasOdometry);
}

TEST(Record, OfATumFileHasNoCovariance)
{
  TemporaryFolder folder;
  const std::string path = folder.write("a.tum", "1.5 1 2 0 0 0 0 1\n2.5 2 2 0 0 0 0 1\n");
  const eval::Record r = loadTumRecord(path);
  ASSERT_EQ(r.rows.size(), 2u);
  EXPECT_EQ(r.rows[1].robot.mean.x, 2);
  EXPECT_FALSE(r.hasMap);
}

TEST(Record, SaysWhatIsNoResultFolder)
{
  TemporaryFolder folder;
  EXPECT_THROW((void)loadRecord(folder.file("")), core::Error);
  folder.write("robot.csv", "t,x\n");
  EXPECT_THROW((void)loadRecord(folder.file("")), core::Error);
}

TEST(Summary, HasExactlyTheKeysOfTheInterface)
{
  const auto json = summaryOf(smallRecord(), {});
  EXPECT_EQ(keysOf(json),
            (std::vector<std::string>{"association", "complete", "dataset", "landmarks", "method",
                                      "mrpt_version", "observations", "particles", "relations",
                                      "rigid", "robot", "scan_map", "seed", "slamot_version",
                                      "steps", "target_set", "targets", "timing"}));
  EXPECT_EQ(keysOf(json["timing"]),
            (std::vector<std::string>{"cpu_s", "peak_rss_mb", "step_median_us", "step_p99_us",
                                      "wall_s"}));
  EXPECT_EQ(keysOf(json["robot"]),
            (std::vector<std::string>{"heading_rmse_rad", "nees_mean", "position_mean_error_m",
                                      "position_median_error_m", "position_rmse_m"}));
  EXPECT_EQ(
      keysOf(json["targets"][0]),
      (std::vector<std::string>{"heading_rmse_rad", "id", "nees_mean", "position_mean_error_m",
                                "position_median_error_m", "position_rmse_m", "tracked_fraction"}));
  EXPECT_EQ(keysOf(json["landmarks"]),
            (std::vector<std::string>{"gospa_m", "gospa_parts_m2", "mapped", "ospa_m", "rmse_m",
                                      "seen", "true"}));
  EXPECT_EQ(keysOf(json["association"]),
            (std::vector<std::string>{"correct", "new", "paired_of_clutter", "rejected",
                                      "right_of_paired", "right_of_sightings", "wrong"}));
  EXPECT_EQ(keysOf(json["particles"]),
            (std::vector<std::string>{"count", "ess_median", "ess_min", "resamplings"}));
}

TEST(Summary, IsNullWhereThereIsNoTruth)
{
  const auto json = summaryOf(smallRecord(), {});
  EXPECT_TRUE(json["robot"]["position_rmse_m"].is_null());
  EXPECT_TRUE(json["targets"][0]["tracked_fraction"].is_null());
  EXPECT_TRUE(json["landmarks"]["gospa_m"].is_null());
  EXPECT_TRUE(json["landmarks"]["ospa_m"].is_null());
  EXPECT_TRUE(json["rigid"].is_null());
  EXPECT_TRUE(json["relations"].is_null());
  EXPECT_TRUE(json["scan_map"].is_null());
  EXPECT_TRUE(json["target_set"].is_null());
  EXPECT_EQ(json["landmarks"]["mapped"], 1);
  EXPECT_EQ(json["particles"]["ess_min"], 4.5);
  EXPECT_EQ(json["particles"]["resamplings"], 1);
}

TEST(Summary, HasTheErrorsOfTheEvaluation)
{
  eval::Truth truth;
  eval::Record record = smallRecord();
  for (const auto& row : record.rows) truth.robot.poses.push_back({row.time, row.robot.mean});
  for (auto& row : record.rows) row.robot.mean.x += 0.25;
  truth.landmarks = {{7, {1, 2.5}}};
  const auto json = summaryOf(record, truth);
  EXPECT_NEAR(json["robot"]["position_mean_error_m"].get<double>(), 0.25, 1e-12);
  EXPECT_EQ(json["landmarks"]["true"], 1);
  EXPECT_NEAR(json["landmarks"]["rmse_m"].get<double>(), 0.5, 1e-12);
  EXPECT_NEAR(json["landmarks"]["gospa_m"].get<double>(), 0.5, 1e-12);
  EXPECT_NEAR(json["landmarks"]["gospa_parts_m2"]["localisation"].get<double>(), 0.25, 1e-12);
  EXPECT_NEAR(json["landmarks"]["ospa_m"].get<double>(), 0.5, 1e-12);
  EXPECT_NEAR(json["rigid"]["robot"]["position_rmse_m"].get<double>(), 0, 1e-9);
  EXPECT_NEAR(json["rigid"]["landmarks"]["rmse_m"].get<double>(), 0, 1e-9);
  EXPECT_EQ(json["association"]["new"], 1);
}

TEST(Summary, HasTheErrorsOverRelations)
{
  eval::Truth truth;
  eval::Record record = smallRecord();
  const eval::RobotRow &first = record.rows.front(), &last = record.rows.back();
  const Pose2D moved = math::between(first.robot.mean, last.robot.mean);
  truth.relations = {{first.time, last.time, math::compose(moved, Pose2D(0.3, 0.4, 0.2))}};
  auto json = summaryOf(record, truth)["relations"];
  EXPECT_EQ(keysOf(json), (std::vector<std::string>{"count", "path", "rotation_mean_error_rad",
                                                    "translation_mean_error_m"}));
  EXPECT_TRUE(json["path"].is_null());
  EXPECT_EQ(json["count"], 1);
  EXPECT_NEAR(json["translation_mean_error_m"].get<double>(), 0.5, 1e-9);
  EXPECT_NEAR(json["rotation_mean_error_rad"].get<double>(), 0.2, 1e-9);
  record.path.poses = {{first.time, {}, true}, {last.time, moved, true}};
  record.path.poses[1].pose.phi += 0.7;
  json = summaryOf(record, truth)["relations"];
  EXPECT_NEAR(json["rotation_mean_error_rad"].get<double>(), 0.2, 1e-9);
  EXPECT_EQ(json["path"]["count"], 1);
  EXPECT_NEAR(json["path"]["rotation_mean_error_rad"].get<double>(), 0.5, 1e-9);
  truth.relations = {{-9, -8, {}}};
  json = summaryOf(record, truth)["relations"];
  EXPECT_EQ(json["count"], 0);
  EXPECT_TRUE(json["translation_mean_error_m"].is_null());
}

TEST(Results, DoNotDependOnTheLocale)
{
  TemporaryFolder folder;
  write(folder.file("a"), smallRecord());
  // Decimal commas, where the machine has such a locale.
  for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8"})
    std::setlocale(LC_ALL, name);
  write(folder.file("b"), smallRecord());
  std::setlocale(LC_ALL, "C");
  for (const char* name : {"summary.json", "robot.csv", "robot.tum", "landmarks.csv"})
    EXPECT_EQ(folder.read(std::string("a/") + name), folder.read(std::string("b/") + name));
}

TEST(StepTimer, TimesEachStepAndPassesItOn)
{
  struct TwoSteps : core::Source
  {
    int count = 0;
    std::optional<core::Step> next() override
    {
      if (++count > 2) return std::nullopt;
      core::Step step;
      step.time = count;
      return step;
    }
  } source;
  StepTimer timer(source);
  while (const auto step = timer.next()) timer.accept(*step, {});
  const Timing t = timer.timing();
  EXPECT_GT(t.wallS, 0);
  EXPECT_GT(t.stepP99Us, 0);
  EXPECT_GE(t.stepP99Us, t.stepMedianUs);
  EXPECT_GT(t.peakRssMb, 1);
}
}  // namespace slamot::results
