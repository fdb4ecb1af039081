#include "../results/TemporaryFolder.h"
#include "expectNear.h"
#include "program.h"

#include <slamot/mrpt/RawlogSource.h>
#include <slamot/results/TruthFiles.h>
#include <slamot/sim/World.h>

#include <algorithm>
#include <filesystem>

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

std::vector<std::string> filesIn(const std::string& folder)
{
  std::vector<std::string> out;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    out.push_back(entry.path().filename().string());
  std::sort(out.begin(), out.end());
  return out;
}

TEST(SimulateCommand, WritesALogForEachRobotOfATeam)
{
  const TemporaryFolder folder;
  const auto outcome = test::slamot("simulate " + kScenarios +
                                        "sim.team-300m.ini --seed 5 -o a.rawlog --set "
                                        "world.steps=100 --set landmark_sensor.range_std_m=3",
                                    folder.file(""));
  ASSERT_EQ(outcome.status, 0) << outcome.text;
  EXPECT_EQ(outcome.text,
            "a.robot0.rawlog: 100 steps, 100 scans, 150 landmarks, 1 target; truth in "
            "a.robot0.truth\n"
            "a.robot1.rawlog: 100 steps, 100 scans, 150 landmarks, 1 target; truth in "
            "a.robot1.truth\n");
  EXPECT_EQ(filesIn(folder.file("")),
            (std::vector<std::string>{"a.robot0.rawlog", "a.robot0.truth", "a.robot1.rawlog",
                                      "a.robot1.truth"}));
  const sim::Scenario s =
      scenario("sim.team-300m.ini", {"world.steps=100", "landmark_sensor.range_std_m=3"});
  for (int robot = 0; robot < 2; ++robot)
  {
    const std::string name = "a.robot" + std::to_string(robot);
    mrpt::RawlogSource source(folder.file(name + ".rawlog"), {});
    sim::World world(s, 5, sim::World::Sightings::kAsRead, robot);
    EXPECT_EQ(expectNear(world, source), 100);
    expectNear(*source.starts().robot, *world.starts().robot);
    expectNear(source.starts().targets.at(0), world.starts().targets.at(0));
    expectNear(results::loadTruth(folder.file(name + ".truth")), world.truth());
  }
}

TEST(SimulateCommand, ATeamsLogsAreAllThereOrNone)
{
  const TemporaryFolder folder;
  // In the way of the second log.
  std::filesystem::create_directory(folder.file("a.robot1.rawlog"));
  const auto outcome =
      test::slamot("simulate " + kScenarios + "sim.team-300m.ini -o a.rawlog --set world.steps=10",
                   folder.file(""));
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.text,
            "slamot: error: a.robot1.rawlog: can't be written: Is a directory; write elsewhere\n");
  EXPECT_EQ(filesIn(folder.file("")), std::vector<std::string>{"a.robot1.rawlog"});
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
  expect(kScenarios + "sim.team-300m.ini -o a.log", 1,
         "--output a.log: is not named as a rawlog; end it in .rawlog");
  expect(kScenarios + "sim.team-300m.ini -o a.rawlog --set robot_3.speed_mps=1", 1,
         "sim.team-300m.ini [robot_3]: is there without [robot_2]; number robots from 0 without a "
         "gap");
  expect("none.ini", 1, "none.ini: can't be read; give the path of an ini file");
  EXPECT_FALSE(std::filesystem::exists(folder.file("a.rawlog")));
  EXPECT_FALSE(std::filesystem::exists(folder.file("a.truth")));
}

TEST(SimulateCommand, ImagesBesideTheLogReplaceOlderOnesWhole)
{
  namespace fs = std::filesystem;
  const TemporaryFolder folder;
  const auto simulate = [&](int steps)
  {
    return test::slamot("simulate " + kScenarios + "sim.pioneers.ini -o a.rawlog --images beside " +
                            "--set world.steps=" + std::to_string(steps),
                        folder.file(""));
  };
  const auto images = [&]
  {
    return std::distance(fs::directory_iterator(folder.file("a_Images")), fs::directory_iterator());
  };
  ASSERT_EQ(simulate(20).status, 0);
  const auto many = images();
  ASSERT_EQ(simulate(10).status, 0);
  EXPECT_LT(images(), many);
  folder.write("a_Images/holiday.png", "sea");
  const std::string log = folder.read("a.rawlog");
  const auto refused = simulate(20);
  EXPECT_EQ(refused.status, 1);
  EXPECT_EQ(refused.text,
            "slamot: error: a_Images: is there and holds other files than simulated images, which "
            "are to replace it; move it away, or give another --output\n");
  EXPECT_EQ(folder.read("a.rawlog"), log);
  EXPECT_EQ(folder.read("a_Images/holiday.png"), "sea");
  for (const auto& entry : fs::directory_iterator(folder.file("")))
    EXPECT_EQ(entry.path().string().find("partial"), std::string::npos) << entry.path();
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
