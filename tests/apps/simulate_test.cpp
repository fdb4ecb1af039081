#include "../results/TemporaryFolder.h"
#include "expectNear.h"
#include "program.h"

#include <slamot/mrpt/RawlogSource.h>
#include <slamot/results/TruthFiles.h>
#include <slamot/sim/World.h>

namespace slamot
{
namespace
{
using test::expectNear;
using test::kTick;
using test::TemporaryFolder;

const std::string kScenarios = SLAMOT_SOURCE_DIR "/config-ini/";
const std::string kDatasets = SLAMOT_SOURCE_DIR "/share/datasets/";

sim::Scenario scenario(const std::string& name, const std::vector<std::string>& changes)
{
  core::Config config = core::Config::load(kScenarios + name);
  for (const std::string& change : changes) config.set(change);
  return sim::Scenario::from(config);
}

// What the program writes for these changes reads as the same world in memory.
void expectSameWorld(const std::string& name, const std::vector<std::string>& changes,
                     const std::string& format)
{
  const TemporaryFolder folder;
  std::string arguments = "simulate " + kScenarios + name + " -q --seed 5 -o '" +
                          folder.file("a.rawlog") + "' --format " + format;
  for (const std::string& change : changes) arguments += " --set '" + change + "'";
  const test::Outcome outcome = test::slamot(arguments);
  ASSERT_EQ(outcome.status, 0) << outcome.text;
  EXPECT_EQ(outcome.text, "");
  const sim::Scenario s = scenario(name, changes);
  mrpt::RawlogSource::Options options;
  // A log of observations holds no covariance.
  options.odometry.fromLog = format == "frames";
  options.odometry.vStd = s.robots.at(0).motion.vStd;
  options.odometry.omegaStd = s.robots.at(0).motion.omegaStd;
  mrpt::RawlogSource source(folder.file("a.rawlog"), options);
  sim::World world(s, 5);
  EXPECT_EQ(expectNear(world, source), s.steps);
  EXPECT_NEAR(*source.starts().time, *world.starts().time, kTick);
  EXPECT_EQ(source.starts().targets.size(), world.starts().targets.size());
  for (const auto& [id, start] : world.starts().targets)
    expectNear(source.starts().targets.at(id), start);
  expectNear(results::loadTruth(folder.file("a.truth")), world.truth());
}

TEST(SimulateCommand, WritesTheWorldThatRunsInMemory)
{
  expectSameWorld("sim.experiment1.ini", {}, "frames");
}

TEST(SimulateCommand, WritesItAsObservationsToo)
{
  expectSameWorld("sim.experiment1.ini", {"world.start_time_s=1700000000"}, "observations");
}

TEST(SimulateCommand, KeepsClutterNoisyRangesAndAbsences)
{
  expectSameWorld(
      "sim.post-field.ini",
      {"world.steps=600", "landmark_sensor.clutter_per_scan=1", "landmark_sensor.range_std_m=0.6",
       "landmark_sensor.bearing_min_deg=-80", "target_sensor.bearing_only=true"},
      "frames");
}

TEST(SimulateCommand, SameSeedSameBytes)
{
  const TemporaryFolder folder;
  for (const std::string name : {"a.rawlog", "b.rawlog"})
    ASSERT_EQ(test::slamot("simulate " + kScenarios + "sim.experiment1.ini --seed 3 -o " + name,
                           folder.file(""))
                  .status,
              0);
  for (const std::string file : {"robot.tum", "target_1.tum", "landmarks.csv", "associations.csv"})
    EXPECT_EQ(folder.read("a.truth/" + file), folder.read("b.truth/" + file));
  EXPECT_EQ(folder.read("a.rawlog"), folder.read("b.rawlog"));
  EXPECT_GT(folder.read("a.rawlog").size(), 5000u);
}

TEST(SimulateCommand, WithoutOutputItNamesTheLogAfterTheScenario)
{
  const TemporaryFolder folder;
  const auto outcome =
      test::slamot("simulate " + kScenarios + "sim.experiment1.ini", folder.file(""));
  EXPECT_EQ(outcome.text,
            "slamot-out/experiment1.rawlog: 320 steps, 40 scans, 20 landmarks, 1 target; truth in "
            "slamot-out/experiment1.truth\n");
  EXPECT_GT(folder.read("slamot-out/experiment1.rawlog").size(), 5000u);
}

TEST(SimulateCommand, WhatIsWrongIsOneLineAndLeavesNothing)
{
  const TemporaryFolder folder;
  const auto expect = [&](const std::string& arguments, int status, const std::string& line)
  {
    const auto outcome = test::slamot("simulate " + arguments, folder.file(""));
    EXPECT_EQ(outcome.status, status);
    EXPECT_EQ(outcome.text, "slamot: error: " + line + "\n");
  };
  const std::string ini = kScenarios + "sim.experiment1.ini";
  expect(ini + " -o a.rawlog --set world.landmark=3", 1,
         "sim.experiment1.ini [world] landmark: unknown key; did you mean landmarks?");
  expect(
      ini + " -o a.rawlog --set world.landmark_spacing_min_m=5", 1,
      "sim.experiment1.ini [world] landmark_spacing_min_m: leaves no place for landmark 5; lower "
      "it, or landmarks");
  expect(ini + " -o a.log", 1, "--output a.log: is not named as a rawlog; end it in .rawlog");
  expect("none.ini", 1, "none.ini: can't be read; give the path of an ini file");
  EXPECT_FALSE(std::filesystem::exists(folder.file("a.rawlog")));
  EXPECT_FALSE(std::filesystem::exists(folder.file("a.truth")));
}

// The command that share/datasets/README.md gives still makes what is shipped.
TEST(Datasets, Experiment1IsWhatItsScenarioMakes)
{
  mrpt::RawlogSource shipped(kDatasets + "experiment1.rawlog", {});
  sim::World world(scenario("sim.experiment1.ini", {}), 1);
  EXPECT_EQ(expectNear(world, shipped), 320);
  expectNear(shipped.starts().targets.at(1), world.starts().targets.at(1));
  expectNear(*shipped.starts().robot, *world.starts().robot);
  expectNear(results::loadTruth(results::truthFolder(kDatasets + "experiment1.rawlog")),
             world.truth());
}

TEST(Datasets, PostFieldIsWhatItsScenarioMakes)
{
  mrpt::RawlogSource shipped(kDatasets + "post-field.rawlog", {});
  sim::World world(scenario("sim.post-field.ini", {}), 1);
  EXPECT_EQ(expectNear(world, shipped), 2400);
  expectNear(results::loadTruth(results::truthFolder(kDatasets + "post-field.rawlog")),
             world.truth());
}

TEST(Datasets, AreSmall)
{
  for (const std::string name : {"experiment1", "post-field"})
  {
    std::uintmax_t bytes = std::filesystem::file_size(kDatasets + name + ".rawlog");
    for (const auto& entry : std::filesystem::directory_iterator(kDatasets + name + ".truth"))
      bytes += entry.file_size();
    EXPECT_LT(bytes, 2'000'000u) << name;
  }
}
}  // namespace
}  // namespace slamot
