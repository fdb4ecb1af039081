#include <slamot/importers/Carmen.h>
#include <slamot/importers/CsvFolder.h>
#include <slamot/importers/Mrclam.h>
#include <slamot/importers/ScaledCars.h>
#include <slamot/importers/VictoriaPark.h>
#include <slamot/mrpt/RawlogSource.h>
#include <slamot/results/TruthFiles.h>

#include "../importers/CarmenData.h"
#include "../importers/MrclamData.h"
#include "../importers/ScaledCarsData.h"
#include "../importers/VictoriaParkData.h"
#include "../results/TemporaryFolder.h"
#include "expectNear.h"
#include "program.h"

namespace slamot
{
namespace
{
using test::expectNear;
using test::TemporaryFolder;

/// An import's steps as a rawlog holds them: what was left out leaves no trace there.
class Written : public core::Source
{
 public:
  explicit Written(importers::Import& import) : import_(import) {}
  std::optional<core::Step> next() override
  {
    auto step = import_.next();
    if (step) step->dropped = 0;
    return step;
  }

 private:
  importers::Import& import_;
};

/// That what the program wrote to <name>.rawlog and <name>.truth reads as the import in memory.
int expectSame(importers::Import& import, const TemporaryFolder& folder,
               const std::string& name = "a")
{
  mrpt::RawlogSource source(folder.file(name + ".rawlog"), {});
  EXPECT_NEAR(*source.starts().time, *import.starts().time, test::kTick);
  EXPECT_EQ(source.starts().robot.has_value(), import.starts().robot.has_value());
  if (import.starts().robot) expectNear(*source.starts().robot, *import.starts().robot);
  EXPECT_EQ(source.starts().targets.size(), import.starts().targets.size());
  for (const auto& [id, start] : import.starts().targets)
    expectNear(source.starts().targets.at(id), start);
  Written written(import);
  const int steps = expectNear(written, source);
  expectNear(results::loadTruth(folder.file(name + ".truth")), import.truth());
  return steps;
}

void writeDrive(const TemporaryFolder& folder)
{
  std::string odometry = "t,v,omega,std_v,std_omega\n", robot = "t,x,y,theta\n0,1,2,0.5\n",
              sightings = "t,range,bearing,std_range,std_bearing,id\n0,3,1,0.1,0.01,5\n";
  for (int i = 1; i <= 20; ++i)
  {
    const std::string t = std::to_string(i * 0.1);
    odometry += t + ",1.5,-0.3,0.05,0.02\n";
    robot += t + ",1." + std::to_string(i) + ",2,\n";
    if (i % 4 == 0) sightings += t + ",,,,,\n";
    if (i % 4 == 1) sightings += t + ",2.5,-1,0.1,0.01,5\n" + t + ",4,1.5,0.2,0.02,-1\n";
    if (i % 4 == 2) sightings += std::to_string(i * 0.1 + 0.0333333) + ",2,0,0.1,0.01,6\n";
  }
  folder.write("drive/odometry.csv", odometry);
  folder.write("drive/truth_robot.csv", robot);
  folder.write("drive/landmark_sightings.csv", sightings);
  folder.write("drive/truth_landmarks.csv", "id,x,y\n5,1,1\n6,2,2\n");
  folder.write("drive/truth_target_3.csv", "t,x,y,theta\n0.5,1,1,\n0.6,1,1,\n");
  folder.write("drive/fov.csv", "range_min,range_max,bearing_min,bearing_max\n0.1,4,-2,1.6\n");
  folder.write("drive/blobs.csv",
               "t,label,range,bearing,std_range,std_bearing,id\n0.5,target,,0.3,,0.01,3\n"
               "0.6,robot,2,-0.3,0.1,0.01,-1\n0.6,robot,2.5,-0.3,0.1,0.01,-1\n0.7,,,,,,\n");
  folder.write("drive/start.csv",
               "object,x,y,theta,vx,vy,ax,ay,std_x,std_y,std_theta,std_vx,std_vy,std_ax,std_ay\n"
               "robot,1,2,0.5,,,,,0,0,0.1,,,,\ntarget_3,4,5,,1,,,,0.1,0.1,,,,,\n");
}

TEST(ImportCommand, CsvFolderReadsBackAsItWas)
{
  const TemporaryFolder folder;
  writeDrive(folder);
  const auto outcome = test::slamot("import csv drive -o a.rawlog", folder.file(""));
  ASSERT_EQ(outcome.status, 0) << outcome.text;
  EXPECT_EQ(outcome.text,
            "a.rawlog: 26 steps, 16 sightings in 16 scans, 3 blobs in 3 scans, 0 laser scans, 0 "
            "dropped, 2.000 s; truth: a.truth\n");
  EXPECT_EQ(expectSame(*importers::openCsvFolder(folder.file("drive")), folder), 26);
}

TEST(ImportCommand, LaserScansComeThrough)
{
  const TemporaryFolder folder;
  folder.write("drive/odometry.csv", "t,v,omega,std_v,std_omega\n0.5,1,0,0,0\n");
  folder.write("drive/scans.csv",
               "t,angle_min,angle_step,range_max,r0,r1,r2\n0.5,-0.4,0.3,8,1.5,inf,2.5\n");
  ASSERT_EQ(test::slamot("import csv drive -q -o a.rawlog", folder.file("")).text, "");
  mrpt::RawlogSource source(folder.file("a.rawlog"), {});
  const auto step = source.next();
  ASSERT_TRUE(step && step->lasers.size() == 1);
  const core::LaserScan& scan = *step->lasers[0];
  EXPECT_NEAR(scan.pose_robot_sensor.phi + scan.angleMin, -0.4, 1e-6);
  EXPECT_NEAR(scan.angleStep, 0.3, 1e-6);
  ASSERT_EQ(scan.ranges.size(), 3u);
  EXPECT_EQ(scan.ranges[2], 2.5f);
  EXPECT_GT(scan.ranges[1], scan.rangeMax);
}

TEST(ImportCommand, MrclamReadsBackAsItWas)
{
  const TemporaryFolder folder;
  test::writeMrclam(folder);
  const auto outcome =
      test::slamot("import mrclam . --robot 1 --no-landmark-ids -o a.rawlog", folder.file(""));
  ASSERT_EQ(outcome.status, 0) << outcome.text;
  EXPECT_NE(outcome.text.find("5 dropped (1 at range <= 0 or out of the field of view, 2 outside "
                              "odometry's time, 2 with an unknown or the robot's own barcode)"),
            std::string::npos)
      << outcome.text;
  importers::MrclamOptions options;
  options.robot = 1;
  options.landmarkIds = false;
  EXPECT_GT(expectSame(*importers::openMrclam(folder.file(""), options), folder), 20);
}

TEST(ImportCommand, MrclamTeamReadsBackAsItWas)
{
  const TemporaryFolder folder;
  test::writeMrclamTeam(folder);
  const auto outcome = test::slamot(
      "import mrclam . --team --target 2 --no-target-ids --hide-landmarks 4,5 -o out/a.rawlog",
      folder.file(""));
  ASSERT_EQ(outcome.status, 0) << outcome.text;
  EXPECT_NE(outcome.text.find("out/a.robot5.rawlog: "), std::string::npos) << outcome.text;
  EXPECT_NE(outcome.text.find("2 hidden landmarks), "), std::string::npos) << outcome.text;
  for (const int robot : {1, 3, 4, 5})
  {
    const std::string name = "out/a.robot" + std::to_string(robot);
    importers::MrclamOptions options;
    options.robot = robot;
    options.target = 2;
    options.targetIds = false;
    options.hideLandmarks = robot >= 4;
    EXPECT_GT(expectSame(*importers::openMrclam(folder.file(""), options), folder, name), 20);
  }
  const auto entries = std::filesystem::directory_iterator(folder.file("out"));
  EXPECT_EQ(std::distance(begin(entries), end(entries)), 8) << "four logs, each with its truth";
}

TEST(ImportCommand, AMrclamTeamIsWholeOrNotThere)
{
  const TemporaryFolder folder;
  test::writeMrclamTeam(folder);
  folder.write("Robot5_Odometry.dat", "1 nan 0\n");
  const auto outcome =
      test::slamot("import mrclam . --team --target 2 -o out/a.rawlog", folder.file(""));
  EXPECT_EQ(outcome.status, 4);
  EXPECT_TRUE(std::filesystem::is_empty(folder.file("out"))) << outcome.text;
}

TEST(ImportCommand, VictoriaParkReadsBackAsItWas)
{
  const TemporaryFolder folder;
  test::writePark(folder);
  for (const char* name : {"inputs.txt", "trees.txt", "laser_cm.txt", "gps_first_600s.txt"})
    test::packGz(folder, name);
  const auto outcome = test::slamot(
      "import victoria-park . -o a.rawlog --lasers --steering-offset 1 --steering-scale 1.5 "
      "--laser-yaw -2 --laser-delay 0.1 --max-range 25 --std-speed 0.1 --std-steering 2 "
      "--std-slip 3 --std-trunk 0.2 --std-range-scale 0.01 --std-bearing 1",
      folder.file(""));
  ASSERT_EQ(outcome.status, 0) << outcome.text;
  EXPECT_EQ(outcome.text,
            "a.rawlog: 4 steps, 2 sightings in 3 scans, 0 blobs in 0 scans, 3 laser scans, 5 "
            "dropped (3 at range <= 0 or out of the field of view, 2 outside odometry's time), "
            "2.000 s; truth: a.truth\n");
  importers::VictoriaParkOptions o;
  o.lasers = true;
  o.steeringOffset = math::degToRad(1);
  o.steeringScale = 1.5;
  o.laserYaw = math::degToRad(-2);
  o.laserDelay = 0.1;
  o.maxRange = 25;
  o.noise = {0.1, math::degToRad(2), math::degToRad(3), 1};
  o.trunkStd = 0.2;
  o.rangeScaleStd = 0.01;
  o.bearingStd = math::degToRad(1);
  EXPECT_EQ(expectSame(*importers::openVictoriaPark(folder.file(""), o), folder), 4);
  for (const auto& pose : results::loadTruth(folder.file("a.truth")).robot.poses)
    EXPECT_FALSE(pose.headingKnown);
}

TEST(ImportCommand, VictoriaParkCutShortLeavesNothing)
{
  const TemporaryFolder folder;
  test::writePark(folder);
  test::packGz(folder, "inputs.txt");
  const std::string whole = folder.read("inputs.txt.gz");
  folder.write("inputs.txt.gz", whole.substr(0, whole.size() / 2));
  const auto outcome = test::slamot("import victoria-park . -o out/a.rawlog", folder.file(""));
  EXPECT_EQ(outcome.status, 3);
  EXPECT_EQ(outcome.text,
            "slamot: error: ./inputs.txt.gz: the compressed file ends early; copy it again\n");
  EXPECT_TRUE(std::filesystem::is_empty(folder.file("out")));
}

TEST(ImportCommand, CarmenReadsBackAsItWas)
{
  const TemporaryFolder folder;
  folder.write("my.log", test::carmenLog() + "FOO 1\n" +
                             test::newScan("ROBOTLASER2", " 0", {5, 8, 2}, {5, 8, 2}, 103));
  test::packGz(folder, "my.log");
  folder.write("my.relations", test::carmenRelations());
  const auto outcome = test::slamot(
      "import carmen my.log.gz -o a.rawlog --relations my.relations --laser-mount 0.1,0.2,3 "
      "--rear-laser-mount -0.1,-0.2,170 --first-beam -60 --beam-step 2 --max-range 75 "
      "--std-distance-driving 0.1 --std-heading-driving 3 --std-distance-turning 0.2 "
      "--std-heading-turning 0.3 --std-slip 4",
      folder.file(""));
  ASSERT_EQ(outcome.status, 0) << outcome.text;
  EXPECT_EQ(outcome.text,
            "slamot: warning: my.log.gz: 1 messages of unknown kind were left out, as 'FOO'\n"
            "a.rawlog: 4 steps, 0 sightings in 0 scans, 0 blobs in 0 scans, 4 laser scans, 0 "
            "dropped, 3.000 s; truth: a.truth\n");
  importers::CarmenOptions o;
  o.relations = folder.file("my.relations");
  o.mount = Pose2D(0.1, 0.2, math::degToRad(3));
  o.rearMount = Pose2D(-0.1, -0.2, math::degToRad(170));
  o.firstBeam = math::degToRad(-60);
  o.beamStep = math::degToRad(2);
  o.maxRange = 75;
  o.noise = {0.1, math::degToRad(4), 0.2, math::degToRad(3), 0.3};
  EXPECT_EQ(expectSame(*importers::openCarmen(folder.file("my.log.gz"), o), folder), 4);
}

TEST(ImportCommand, CarmensRelationsAreEvaluated)
{
  const TemporaryFolder folder;
  folder.write("my.log", test::carmenLog());
  folder.write("my.relations", test::carmenRelations());
  const auto run = [&](const std::string& arguments)
  {
    const auto outcome = test::slamot(arguments, folder.file(""));
    EXPECT_EQ(outcome.status, 0) << outcome.text;
    return outcome.text;
  };
  run("import carmen my.log --relations my.relations -q -o a.rawlog");
  const std::string text =
      run("run '" SLAMOT_SOURCE_DIR "/config-ini/dead-reckoning.ini' a.rawlog -o out");
  const std::string line =
      "relations                 2 between its poses; mean errors 0.000 m, "
      "0.0000 rad\n";
  EXPECT_NE(text.find(line), std::string::npos) << text;
  EXPECT_NE(run("evaluate out").find(line), std::string::npos);
  EXPECT_NE(run("evaluate out --json").find("\"relations\": {\n    \"count\": 2,"),
            std::string::npos);
  EXPECT_NE(folder.read("out/summary.json").find("\"count\": 2,"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(folder.file("out/grid.png")));
}

TEST(ImportCommand, CarmenCutShortLeavesNothing)
{
  const TemporaryFolder folder;
  folder.write("my.log", test::carmenLog());
  test::packGz(folder, "my.log");
  const std::string whole = folder.read("my.log.gz");
  folder.write("my.log.gz", whole.substr(0, whole.size() / 2));
  const auto outcome = test::slamot("import carmen my.log.gz -o out/a.rawlog", folder.file(""));
  EXPECT_EQ(outcome.status, 3);
  EXPECT_EQ(outcome.text,
            "slamot: error: my.log.gz: the compressed file ends early; copy it again\n");
  EXPECT_TRUE(std::filesystem::is_empty(folder.file("out")));
}

TEST(ImportCommand, ScaledCarsReadBackAsTheyWere)
{
  const TemporaryFolder folder;
  test::writeCars(folder);
  for (const char* name : {"scan.csv", "imu.csv", "ego_pose.csv"}) test::packGz(folder, name);
  const auto outcome = test::slamot(
      "import scaled-cars . -o a.rawlog --heading wheels --gyro-bias 1 --true-heading logged "
      "--wheel-radius 0.04 --wheelbase 0.3 --track 0.2 --ahead -0.1 --laser-mount -0.2,0.1,2 "
      "--laser-delay 0.1 --max-range 5 --std-distance 0.03 --std-distance-turning 0.04 "
      "--std-heading 2 --std-heading-turning 0.05 --start origin",
      folder.file(""));
  ASSERT_EQ(outcome.status, 0) << outcome.text;
  EXPECT_EQ(outcome.text,
            "a.rawlog: 13 steps, 0 sightings in 0 scans, 0 blobs in 0 scans, 13 laser scans, 2 "
            "dropped (2 outside odometry's time), 3.000 s; truth: a.truth\n");
  using Options = importers::ScaledCarsOptions;
  Options o;
  o.heading = Options::Heading::kWheels;
  o.gyroBias = math::degToRad(1);
  o.trueHeading = Options::TrueHeading::kLogged;
  o.wheelRadius = 0.04;
  o.wheelbase = 0.3;
  o.track = 0.2;
  o.ahead = -0.1;
  o.mount = Pose2D(-0.2, 0.1, math::degToRad(2));
  o.laserDelay = 0.1;
  o.maxRange = 5;
  o.wheels = {0.03, 0.04, math::degToRad(2), 0.05};
  o.startFromTruth = false;
  EXPECT_EQ(expectSame(*importers::openScaledCars(folder.file(""), o), folder), 13);
}

TEST(ImportCommand, ScaledCarsAreDrivenThroughTheirTruth)
{
  const TemporaryFolder folder;
  test::writeCars(folder);
  for (const char* arguments :
       {"import scaled-cars . -q -o a.rawlog",
        "run '" SLAMOT_SOURCE_DIR "/config-ini/dead-reckoning.ini' a.rawlog -q -o out"})
  {
    const auto outcome = test::slamot(arguments, folder.file(""));
    ASSERT_EQ(outcome.status, 0) << outcome.text;
  }
  const std::string text = test::slamot("evaluate out", folder.file("")).text;
  EXPECT_NE(text.find("(align none)"), std::string::npos) << "the start is the truth's\n" << text;
  EXPECT_NE(text.find("\nrobot                          13    0.00"), std::string::npos) << text;
  EXPECT_NE(text.find("target 1"), std::string::npos) << text;
}

TEST(ImportCommand, WhatIsWrongIsOneLineAndLeavesNothing)
{
  const TemporaryFolder folder;
  const auto expect = [&](const std::string& arguments, int status, const std::string& line)
  {
    const auto outcome = test::slamot("import " + arguments, folder.file(""));
    EXPECT_EQ(outcome.status, status);
    EXPECT_EQ(outcome.text, "slamot: error: " + line + "\n");
    EXPECT_FALSE(std::filesystem::exists(folder.file("a.rawlog")));
    EXPECT_FALSE(std::filesystem::exists(folder.file("a.truth")));
  };
  writeDrive(folder);
  folder.write("drive/odometry.csv", "t,v,omega,std_v,std_omega\n0.1,1,0,0,0\n0.2,nan,0,0,0\n");
  expect("csv drive -o a.rawlog", 4,
         "drive/odometry.csv line 3: column v: 'nan' makes no sense; values must be finite and "
         "below 1e10");
  folder.write("drive/odometry.csv", "t,v,omega,std_v,std_omega\n0.1,1,0,0\n");
  expect("csv drive -o a.rawlog", 2,
         "drive/odometry.csv line 2: the row has 4 columns instead of 5; write commas between "
         "fields and '.' as decimal point");
  expect("csv nowhere -o a.rawlog", 2,
         "nowhere: is not a folder; give a folder with an odometry.csv");
  expect("xml drive -o a.rawlog", 1,
         "command line: kind: xml not in {csv,mrclam,victoria-park,carmen,scaled-cars}; see slamot "
         "--help");
  expect("csv drive --robot 1 -o a.rawlog", 1,
         "command line: --robot is an option of mrclam; remove it");
  expect("mrclam drive --start-time 3 -o a.rawlog", 1,
         "command line: --start-time is an option of csv; remove it");
  expect("csv drive --std-bearing 1 -o a.rawlog", 1,
         "command line: --std-bearing is an option of mrclam and victoria-park; remove it");
  expect("mrclam drive --robot 1 --laser-yaw 1 -o a.rawlog", 1,
         "command line: --laser-yaw is an option of victoria-park; remove it");
  expect("csv drive --std-slip 1 -o a.rawlog", 1,
         "command line: --std-slip is an option of victoria-park and carmen; remove it");
  expect("victoria-park drive --std-heading-turning 1 -o a.rawlog", 1,
         "command line: --std-heading-turning is an option of mrclam, carmen and scaled-cars; "
         "remove it");
  expect("mrclam drive --robot 1 --laser-mount 1,2,3 -o a.rawlog", 1,
         "command line: --laser-mount is an option of carmen and scaled-cars; remove it");
  expect("carmen drive --start origin -o a.rawlog", 1,
         "command line: --start is an option of mrclam and scaled-cars; remove it");
  expect("scaled-cars drive --relations x -o a.rawlog", 1,
         "command line: --relations is an option of carmen; remove it");
  expect("carmen x.log --heading imu -o a.rawlog", 1,
         "command line: --heading is an option of scaled-cars; remove it");
  expect("victoria-park drive --max-range 90 -o a.rawlog", 1,
         "--max-range: the laser reaches from 1 to 80 m; give 2 to 80");
  expect("carmen drive -o a.rawlog", 2, "drive: is a folder; give a text file");
  expect("carmen nowhere.log -o a.rawlog", 2,
         "nowhere.log: can't be read: No such file or directory; check the name and the rights");
  folder.write("drive/a.log", "FLASER 2 1 nan 0 0 0 0 0 0 1 host 0\n");
  expect("carmen drive/a.log -o a.rawlog", 4,
         "drive/a.log line 1: field 4: 'nan' makes no sense; values must be finite and below 1e10");
  expect("scaled-cars drive -o a.rawlog", 2,
         "drive/wheel_speeds.csv: neither this nor its .gz is there; give the folder of one run of "
         "the scaled cars");
  expect("victoria-park drive --robot 1 -o a.rawlog", 1,
         "command line: --robot is an option of mrclam; remove it");
  expect("victoria-park drive -o a.rawlog", 2,
         "drive/inputs.txt: neither this nor its .gz is there; give the folder of Victoria Park");
  expect("mrclam drive -o a.rawlog", 1,
         "command line: mrclam needs a robot; add --robot N, 1 to 5");
  const std::string team = "mrclam drive -o a.rawlog --team";
  expect(team, 1, "command line: --team needs a target; add --target N, 1 to 5");
  expect(team + " --target 6", 1,
         "command line: --target: Value 6 not in range 1 to 5; see slamot --help");
  expect(team + " --target 2 --robot 1", 1,
         "command line: --robot is one robot and --team are all; remove one");
  expect(team + " --target 2 --start origin", 1,
         "command line: --start origin leaves a team without a common frame; remove it");
  expect(team + " --target 2 --hide-landmarks 1,2", 1,
         "command line: --hide-landmarks names the target, which has no log; name other robots");
  expect("mrclam drive -o a.rawlog --target 2", 1,
         "command line: --target is for a team; add --team");
  expect("csv drive -o a.rawlog --team", 1,
         "command line: --team is an option of mrclam; remove it");
  expect("csv drive -o a.log", 1, "--output a.log: is not named as a rawlog; end it in .rawlog");
}

TEST(ImportCommand, OlderTruthIsReplaced)
{
  const TemporaryFolder folder;
  writeDrive(folder);
  ASSERT_EQ(test::slamot("import csv drive -o a.rawlog", folder.file("")).status, 0);
  folder.write("bare/odometry.csv", "t,v,omega,std_v,std_omega\n0.1,1,0,0,0\n");
  const auto outcome = test::slamot("import csv bare -o a.rawlog", folder.file(""));
  EXPECT_NE(outcome.text.find("truth: none"), std::string::npos) << outcome.text;
  const eval::Truth truth = results::loadTruth(folder.file("a.truth"));
  EXPECT_TRUE(truth.robot.empty() && truth.targets.empty() && truth.landmarks.empty());
}

}  // namespace
}  // namespace slamot
