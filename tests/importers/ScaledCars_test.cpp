#include "ScaledCarsData.h"

#include <slamot/core/checkStep.h>
#include <slamot/importers/ScaledCars.h>

#include "CsvData.h"
#include "expectError.h"

namespace slamot::importers
{
namespace
{
using namespace slamot::test;
using core::ExitStatus;
using Options = ScaledCarsOptions;

std::vector<core::Step> importCars(const TemporaryFolder& folder, const Options& options = {})
{
  return stepsOf(*openScaledCars(folder.file(""), options));
}

/// Where dead reckoning from the true start ends, less where the car truly is then.
Pose2D drift(const TemporaryFolder& folder, const Options& options)
{
  const auto import = openScaledCars(folder.file(""), options);
  Gaussian<Pose2D> pose = import->starts().robotPose();
  double time = 0;
  for (const core::Step& step : stepsOf(*import))
  {
    if (step.odometry) pose = math::compose(pose, *step.odometry);
    time = step.time;
  }
  const auto truth = MadeUpCar::pose(time);
  return {pose.mean.x - truth[0], pose.mean.y - truth[1], math::wrapToPi(pose.mean.phi - truth[2])};
}

double size(const Pose2D& p)
{
  return std::abs(p.x) + std::abs(p.y) + std::abs(p.phi);
}

TEST(ScaledCars, EveryScanWithinOdometrysTimeEndsAStep)
{
  const TemporaryFolder folder;
  writeCars(folder);
  const auto import = openScaledCars(folder.file(""), {});
  EXPECT_EQ(import->starts().time, 10);
  const auto steps = stepsOf(*import);
  ASSERT_EQ(steps.size(), 13u);
  for (std::size_t i = 0; i < steps.size(); ++i)
  {
    core::checkStep(steps[i], i ? steps[i - 1].time : 10);
    EXPECT_NEAR(steps[i].time, 10 + 0.25 * static_cast<double>(i), 1e-9);
    EXPECT_EQ(steps[i].odometry.has_value(), i > 0);
    EXPECT_EQ(steps[i].lasers.size(), 1u);
  }
  EXPECT_EQ(import->counts().outOfTime, 2u);
  const core::LaserScan& scan = *steps[3].lasers[0];
  EXPECT_EQ(scan.pose_robot_sensor, Pose2D(-0.12, 0, 0));
  EXPECT_NEAR(scan.angleMin, -3.124139, 1e-9);
  EXPECT_NEAR(scan.angleStep, math::degToRad(1), 1e-12);
  ASSERT_EQ(scan.ranges.size(), 360u);
  EXPECT_EQ(scan.ranges[359], 1.5f);
  EXPECT_GT(steps[0].lasers[0]->ranges[0], scan.rangeMax) << "0 is no return";
  EXPECT_GT(steps[12].lasers[0]->ranges[0], scan.rangeMax) << "9 m is too far";
}

TEST(ScaledCars, DeadReckoningIsThatOfTheTruthsPoint)
{
  const TemporaryFolder folder;
  writeCars(folder);
  EXPECT_LT(size(drift(folder, {})), 5e-3);
  Options wheels;
  wheels.heading = Options::Heading::kWheels;
  EXPECT_LT(size(drift(folder, wheels)), 5e-3);
  for (const auto member : {&Options::wheelRadius, &Options::wheelbase, &Options::ahead})
  {
    Options wrong;
    wrong.*member *= 1.5;
    EXPECT_GT(size(drift(folder, wrong)), 0.02);
  }
}

TEST(ScaledCars, GyrosBiasIsThatAtRest)
{
  const TemporaryFolder folder;
  writeCars(folder);
  Options options;
  options.gyroBias = 0;
  EXPECT_NEAR(drift(folder, options).phi, 0.03, 2e-3) << "0.01 rad/s for 3 s";
  std::string wheels = kWheelsHeader;
  for (int i = 0; i <= 300; ++i) wheels += csvRow({10 + 0.01 * i, 1, 1, 1, 1});
  folder.write("wheel_speeds.csv", wheels);
  const auto import = openScaledCars(folder.file(""), {});
  ASSERT_FALSE(import->warnings().empty());
  EXPECT_NE(import->warnings().back().find("--gyro-bias"), std::string::npos);
}

TEST(ScaledCars, TrueHeadingsAreAlignedWithDriving)
{
  const TemporaryFolder folder;
  writeCars(folder);
  const auto import = openScaledCars(folder.file(""), {});
  stepsOf(*import);
  const eval::Truth& truth = import->truth();
  ASSERT_EQ(truth.robot.poses.size(), 13u);
  ASSERT_EQ(truth.targets.size(), 1u);
  for (std::size_t i = 0; i < truth.robot.poses.size(); ++i)
  {
    const eval::TimedPose& pose = truth.robot.poses[i];
    EXPECT_TRUE(pose.headingKnown);
    EXPECT_NEAR(math::wrapToPi(pose.pose.phi - MadeUpCar::pose(pose.time)[2]), 0, 3e-3) << i;
  }
  EXPECT_NEAR(truth.targets.at(1).poses.back().pose.phi, 0, 1e-3);
  EXPECT_NEAR(*import->starts().robot->value[core::ObjectStart::kTheta], math::kPi / 2, 3e-3);

  Options options;
  options.trueHeading = Options::TrueHeading::kLogged;
  const auto logged = openScaledCars(folder.file(""), options);
  EXPECT_NEAR(*logged->starts().robot->value[core::ObjectStart::kTheta],
              math::kPi / 2 + MadeUpCar::kHeadingOff, 1e-9);
  stepsOf(*logged);
  EXPECT_NEAR(logged->truth().targets.at(1).poses.back().pose.phi, -0.1, 1e-9);

  options.trueHeading = Options::TrueHeading::kNone;
  options.startFromTruth = false;
  const auto none = openScaledCars(folder.file(""), options);
  EXPECT_FALSE(none->starts().robot);
  stepsOf(*none);
  EXPECT_FALSE(none->truth().robot.poses[3].headingKnown);
  options.startFromTruth = true;
  expectError(ExitStatus::kUnreadable, {"ego_pose.csv", "--start origin"},
              [&] { (void)openScaledCars(folder.file(""), options); });
}

TEST(ScaledCars, TellsWhereTargetsStartIfAskedTo)
{
  const TemporaryFolder folder;
  writeCars(folder);
  Options options;
  EXPECT_TRUE(openScaledCars(folder.file(""), options)->starts().targets.empty());
  options.targetStarts = true;
  const auto import = openScaledCars(folder.file(""), options);
  const auto steps = stepsOf(*import);
  const Pose2D first = import->truth().targets.at(1).poses.front().pose;
  const core::ObjectStart& start = import->starts().targets.at(1);
  EXPECT_NEAR(*start.value[core::ObjectStart::kX], first.x, 1e-12);
  EXPECT_NEAR(*start.value[core::ObjectStart::kY], first.y, 1e-12);
}

TEST(ScaledCars, AHeadingThatDrivingDoesNotExplainIsUnknown)
{
  const TemporaryFolder folder;
  writeCars(folder);
  std::string poses = kPoseHeader;  // drives along x, its heading to and fro by 0.4 rad
  for (int i = 0; i <= 300; ++i)
    poses += csvRow({10 + 0.01 * i, 0.01 * i, 0, 0, 0, 0, i / 75 % 2 ? 0.4 : -0.4});
  folder.write("target2_pose.csv", poses);
  const auto import = openScaledCars(folder.file(""), {});
  stepsOf(*import);
  EXPECT_TRUE(import->truth().targets.at(1).poses[0].headingKnown);
  EXPECT_FALSE(import->truth().targets.at(2).poses[0].headingKnown);
  ASSERT_EQ(import->warnings().size(), 1u);
  EXPECT_NE(import->warnings()[0].find("true heading of target 2"), std::string::npos);
}

TEST(ScaledCars, LasersDelayShiftsScansAndTheirMountIsTold)
{
  const TemporaryFolder folder;
  writeCars(folder);
  Options options;
  options.laserDelay = 0.05;
  options.mount = Pose2D(-0.1, 0.02, 0.3);
  const auto steps = importCars(folder, options);
  EXPECT_NEAR(steps[0].time, 10.2, 1e-9);
  EXPECT_EQ(steps[0].lasers[0]->pose_robot_sensor, options.mount);
}

TEST(ScaledCars, TruthHasGapsWhereTheDataHas)
{
  const TemporaryFolder folder;
  writeCars(folder);
  std::string poses = kPoseHeader;
  for (int i = 0; i <= 300; ++i)
    if (i < 90 || i > 110) poses += csvRow({10 + 0.01 * i, 0.01 * i, 0, 0, 0, 0, 0});
  folder.write("target_pose.csv", poses);
  const auto import = openScaledCars(folder.file(""), {});
  stepsOf(*import);
  EXPECT_EQ(import->truth().targets.at(1).poses.size(), 12u);
  std::filesystem::remove(folder.file("ego_pose.csv"));
  expectError(ExitStatus::kUnreadable, {"no truth", "--start origin"}, [&] { importCars(folder); });
}

TEST(ScaledCars, TakesPackedFilesAndSaysWhenOneIsCutShort)
{
  const TemporaryFolder folder;
  writeCars(folder);
  const std::vector<std::string> names = {"scan.csv", "wheel_speeds.csv", "imu.csv", "ego_pose.csv",
                                          "target_pose.csv"};
  for (const std::string& name : names) packGz(folder, name);
  EXPECT_EQ(importCars(folder).size(), 13u);
  for (const std::string& name : names)
  {
    const std::string whole = folder.read(name + ".gz");
    folder.write(name + ".gz", whole.substr(0, whole.size() - 9));
    expectError(ExitStatus::kTruncated, {name + ".gz", "ends early"}, [&] { importCars(folder); });
    folder.write(name + ".gz", whole);
  }
}

/// A sound folder with one file replaced; its import must fail as said.
void expectFault(const std::string& file, const std::string& text, ExitStatus status,
                 const std::vector<std::string>& parts)
{
  SCOPED_TRACE(file + ":\n" + text.substr(0, 200));
  const TemporaryFolder folder;
  writeCars(folder);
  folder.write(file, text);
  expectError(status, parts, [&] { importCars(folder); });
}

constexpr auto kBad = ExitStatus::kUnreadable;
constexpr auto kNonsense = ExitStatus::kNonsense;

TEST(ScaledCarsFaults, OfOdometryAreNamed)
{
  std::string file = "wheel_speeds.csv";
  expectFault(file, "", kBad, {file, "is empty"});
  expectFault(file, "garbage\x01\n", kBad, {file, "the header is"});
  expectFault(file, kWheelsHeader, kBad, {file, "holds no rows"});
  expectFault(file, kWheelsHeader + "10,1,nan,1,1\n", kNonsense, {file + " line 2", "column FR"});
  expectFault(file, kWheelsHeader + "10,1,1,1\n", kBad, {"4 columns instead of 5"});
  expectFault(file, kWheelsHeader + "10,1,1,1,x\n", kBad, {"column BR", "'x' is not a number"});
  expectFault(file, kWheelsHeader + "10,1,1,1,2000\n", kNonsense, {"column BR", "no car"});
  expectFault(file, kWheelsHeader + "10,1,1,1,1\n9,1,1,1,1\n", kNonsense, {"line 3", "backwards"});
  expectFault(file, kWheelsHeader + "10,1,1,1,1\n12,1,1,1,1\n", kNonsense, {"line 3", "over 1 s"});
  expectFault(file, kWheelsHeader + "90,1,1,1,1\n", kNonsense, {"no time in common"});
  file = "imu.csv";
  expectFault(file, kImuHeader + "10,0,0,0,0,0,inf,0,0,0\n", kNonsense, {"line 2", "column wz"});
  expectFault(file, kImuHeader + "10,0,0,0,0,0,300,0,0,0\n", kNonsense, {"column wz", "radians"});
  expectFault(file, kImuHeader, kBad, {file, "holds no rows"});
}

TEST(ScaledCarsFaults, OfScansAndTruthAreNamed)
{
  std::string file = "scan.csv";
  expectFault(file, carScanHeader(), kBad, {file, "holds no rows"});
  expectFault(file, "t,r0\n1,1\n", kBad, {file, "the header is"});
  expectFault(file, carScanHeader() + "10.5,10.6,1\n", kBad, {"3 columns instead of 362"});
  expectFault(file, carScanHeader() + carScan(10.5, -1), kNonsense, {"line 2", "column r0"});
  expectFault(file, carScanHeader() + carScan(10.5, std::nan("")), kNonsense, {"column r0"});
  expectFault(file, carScanHeader() + carScan(10.5, 1) + carScan(10.4, 1), kNonsense,
              {"line 3", "backwards"});
  expectFault(file, carScanHeader() + carScan(10.5, 1) + carScan(10.5, 1), kNonsense,
              {"line 3", "two scans"});
  file = "ego_pose.csv";
  expectFault(file, kPoseHeader + "10,1,nan,0,0,0,0\n", kNonsense, {file + " line 2", "column y"});
  expectFault(file, kPoseHeader + "10,1,1,0,0,0,0\n9,1,1,0,0,0,0\n", kNonsense, {"backwards"});
  expectFault("target3_pose.csv", "t,x\n", kBad, {"target3_pose.csv", "the header is"});
  for (const char* name : {"scan.csv", "wheel_speeds.csv", "imu.csv"})
  {
    const TemporaryFolder folder;
    writeCars(folder);
    std::filesystem::remove(folder.file(name));
    expectError(kBad, {name, "neither this nor its .gz"}, [&] { importCars(folder); });
  }
}
}  // namespace
}  // namespace slamot::importers
