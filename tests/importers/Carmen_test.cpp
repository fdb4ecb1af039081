#include <slamot/core/checkStep.h>
#include <slamot/importers/Carmen.h>

#include "CarmenData.h"
#include "CsvData.h"
#include "expectError.h"

namespace slamot::importers
{
namespace
{
using namespace slamot::test;
using core::ExitStatus;

std::vector<core::Step> importText(const std::string& text, const CarmenOptions& options = {})
{
  const TemporaryFolder folder;
  const auto steps = stepsOf(*openCarmen(folder.write("a.log", text), options));
  for (std::size_t i = 0; i < steps.size(); ++i)
    core::checkStep(steps[i], i ? steps[i - 1].time : 0);
  return steps;
}

core::LaserScan firstScan(const std::string& text, const CarmenOptions& options = {})
{
  return *importText(text, options).at(0).lasers.at(0);
}

TEST(Carmen, EveryScanEndsAStepWithTheOdometrySinceTheOneBefore)
{
  const TemporaryFolder folder;
  const auto import = openCarmen(folder.write("a.log", carmenLog()), {});
  EXPECT_EQ(import->starts().time, 100);
  EXPECT_FALSE(import->starts().robot);
  const auto steps = stepsOf(*import);
  ASSERT_EQ(steps.size(), 3u);
  EXPECT_FALSE(steps[0].odometry) << "nothing tells how the robot came there";
  EXPECT_EQ(steps[0].time, 100);
  EXPECT_EQ(steps[1].time, 101.25);
  EXPECT_EQ(steps[2].time, 102.5);
  const Pose2D &drive = steps[1].odometry->mean, &turn = steps[2].odometry->mean;
  EXPECT_NEAR(drive.x, 2 * std::sin(1.5), 1e-12);
  EXPECT_NEAR(drive.y, 2 * std::cos(1.5), 1e-12);
  EXPECT_NEAR(std::hypot(turn.x, turn.y), 0, 1e-12);
  EXPECT_NEAR(turn.phi, 0.5, 1e-12);
  for (const core::Step& step : steps) EXPECT_EQ(step.lasers.size(), 1u);
  EXPECT_TRUE(import->warnings().empty());
  EXPECT_TRUE(import->truth().robot.empty());
}

TEST(Carmen, RangesFromTheLargestOnAreNoReturns)
{
  const auto steps = importText(carmenLog());
  const core::LaserScan &second = *steps[1].lasers[0], &third = *steps[2].lasers[0];
  EXPECT_EQ(second.rangeMax, 80);
  EXPECT_EQ(second.ranges[0], 1.5f);
  EXPECT_GT(second.ranges[1], 80) << "80 m itself";
  EXPECT_GT(second.ranges[2], 80);
  EXPECT_GT(third.ranges[0], 80) << "zero";
  EXPECT_GT(third.ranges[1], 80);
  EXPECT_EQ(third.ranges[2], 4);
  CarmenOptions options;
  options.maxRange = 2.5;
  EXPECT_GT(firstScan(carmenLog(), options).ranges[2], 2.5);
}

TEST(Carmen, BeamsLieAsTheirNumberSays)
{
  struct Case
  {
    std::size_t n;
    double first, last;  // [deg]
  };
  for (const Case& c : {Case{180, -90, 89}, Case{181, -90, 90}, Case{360, -90, 89.5},
                        Case{361, -90, 90}, Case{401, -50, 50}, Case{5, -90, 90}})
  {
    const auto scan = firstScan(oldScan("FLASER", std::vector<double>(c.n, 3), {0, 0, 0}, 1));
    ASSERT_EQ(scan.ranges.size(), c.n);
    EXPECT_NEAR(math::radToDeg(scan.angleMin), c.first, 1e-9) << c.n;
    EXPECT_NEAR(math::radToDeg(scan.angleMin + scan.angleStep * static_cast<double>(c.n - 1)),
                c.last, 1e-9)
        << c.n;
    EXPECT_EQ(scan.pose_robot_sensor, Pose2D(0, 0, 0));
  }
  CarmenOptions options;
  options.firstBeam = 0.3;
  options.beamStep = 0.1;
  options.mount = Pose2D(1, 2, 0.5);
  const auto scan = firstScan(oldScan("FLASER", {1, 2}, {0, 0, 0}, 1), options);
  EXPECT_EQ(scan.angleMin, 0.3);
  EXPECT_EQ(scan.angleStep, 0.1);
  EXPECT_EQ(scan.pose_robot_sensor, Pose2D(1, 2, 0.5));
  EXPECT_TRUE(importText(oldScan("FLASER", {}, {0, 0, 0}, 1)).at(0).lasers.empty());
}

TEST(Carmen, RearLasersFaceBackAndShareTheStepOfTheirInstant)
{
  const std::string both =
      oldScan("FLASER", {1, 2}, {0, 0, 0}, 7) + oldScan("RLASER", {3, 4}, {0, 0, 0}, 7);
  auto steps = importText(both);
  ASSERT_EQ(steps.size(), 1u);
  ASSERT_EQ(steps[0].lasers.size(), 2u);
  EXPECT_EQ(steps[0].lasers[1]->pose_robot_sensor, Pose2D(0, 0, math::kPi));
  CarmenOptions options;
  options.rearMount = Pose2D(-0.2, 0, 3);
  EXPECT_EQ(importText(both, options)[0].lasers[1]->pose_robot_sensor, Pose2D(-0.2, 0, 3));
}

TEST(Carmen, RobotLasersTellTheirMountAndBeamsWithOrWithoutRemissions)
{
  // The laser is 0.2 m ahead of a robot that faces along y.
  const std::vector<double> laser = {4, 5.2, math::kPi / 2}, robot = {4, 5, math::kPi / 2};
  for (const std::string remissions : {"", " 0", " 2 11 12", " 3 1 2 3"})
  {
    SCOPED_TRACE(remissions);
    const auto scan = firstScan(newScan("ROBOTLASER1", remissions, laser, robot, 9));
    EXPECT_NEAR(scan.pose_robot_sensor.x, 0.2, 1e-12);
    EXPECT_NEAR(scan.pose_robot_sensor.y, 0, 1e-12);
    EXPECT_NEAR(scan.pose_robot_sensor.phi, 0, 1e-12);
    EXPECT_EQ(scan.angleMin, -0.5);
    EXPECT_EQ(scan.angleStep, 0.25);
    EXPECT_EQ(scan.rangeMax, 20);
    ASSERT_EQ(scan.ranges.size(), 3u);
    EXPECT_EQ(scan.ranges[2], 19.9f);
  }
  const auto steps = importText(newScan("ROBOTLASER2", " 0", laser, robot, 9) +
                                newScan("ROBOTLASER1", "", laser, {4, 6, math::kPi / 2}, 10));
  EXPECT_NEAR(steps.at(1).odometry->mean.x, 1, 1e-12) << "of the robot, not of the laser";
  CarmenOptions options;
  options.mount = Pose2D(1, 0, 0);
  EXPECT_EQ(firstScan(newScan("ROBOTLASER1", "", laser, robot, 9), options).pose_robot_sensor,
            Pose2D(1, 0, 0));
}

TEST(Carmen, PosesMayComeFromOdomLines)
{
  CarmenOptions options;
  options.odometryLines = true;
  const std::string text =
      oldScan("FLASER", {1}, {0, 0, 0}, 9.9) + odometryLine({0, 0, 0}, 10) +
      oldScan("FLASER", {1}, {50, 0, 0}, 10) + oldScan("FLASER", {1}, {60, 0, 0}, 10.25) +
      odometryLine({4, 0, 0.4}, 10.5) + oldScan("FLASER", {1}, {0, 0, 0}, 10.7) +
      odometryLine({5, 0, 0.4}, 12) + oldScan("FLASER", {1}, {0, 0, 0}, 12.1);
  const TemporaryFolder folder;
  const auto import = openCarmen(folder.write("a.log", text), options);
  const auto steps = stepsOf(*import);
  ASSERT_EQ(steps.size(), 2u);
  EXPECT_EQ(steps[1].time, 10.25);
  EXPECT_NEAR(steps[1].odometry->mean.x, 2, 1e-12);
  EXPECT_NEAR(steps[1].odometry->mean.phi, 0.2, 1e-12);
  EXPECT_EQ(import->counts().outOfTime, 3u) << "before, in a gap of 1.5 s, after";
  expectError(
      ExitStatus::kUnreadable, {"a.log", "--odometry lines"},
      [&] {
        (void)openCarmen(folder.write("a.log", oldScan("FLASER", {1}, {0, 0, 0}, 1)), options);
      });
}

TEST(Carmen, MessagesSlightlyOutOfOrderAreSorted)
{
  const std::string first = oldScan("FLASER", {1}, {0, 0, 0}, 100),
                    second = oldScan("FLASER", {1}, {1, 0, 0}, 100.4),
                    third = oldScan("FLASER", {1}, {2, 0, 0}, 101.3);
  const auto steps = importText(second + first + third);
  ASSERT_EQ(steps.size(), 3u);
  EXPECT_EQ(steps[0].time, 100);
  EXPECT_NEAR(steps[1].odometry->mean.x, 1, 1e-12);
  expectError(ExitStatus::kNonsense, {"a.log line 2", "goes back", "sort"},
              [&] { importText(third + first); });
  const std::string far = oldScan("FLASER", {1}, {2, 0, 0}, 103);
  expectError(ExitStatus::kNonsense, {"a.log line 3", "goes back"},
              [&] { importText(second + far + third); });
}

TEST(Carmen, NoiseDoesNotDependOnHowADriveIsCut)
{
  const DrivenNoise noise = CarmenOptions().noise;
  const Pose2D half(0.5, 0, 0);
  const auto whole = noise.of({1, 0, 0}), parts = math::compose(noise.of(half), noise.of(half));
  EXPECT_NEAR((whole.cov - parts.cov).cwiseAbs().maxCoeff(), 0, 1e-15);
  EXPECT_GT(whole.cov(1, 1), 0.05 * 0.05);
  EXPECT_NEAR(std::sqrt(whole.cov(0, 0)), noise.distance, 1e-12);
  EXPECT_EQ(noise.of({0, 0, 0}).cov.norm(), 0);
  // Sideways drives err along themselves, too.
  const auto sideways = noise.of({0, 1, 0});
  EXPECT_NEAR(sideways.cov(1, 1), whole.cov(0, 0), 1e-15);
  EXPECT_NEAR(sideways.cov(0, 2), -whole.cov(1, 2), 1e-15);
  EXPECT_NEAR(std::sqrt(noise.of({0, 0, -1}).cov(2, 2)), noise.headingTurning, 1e-12);
}

TEST(Carmen, WhatIsUnknownOrJumpsIsWarnedOf)
{
  const TemporaryFolder folder;
  const auto import = openCarmen(folder.write("a.log", carmenLog() + "FOO 1 2\nBAR 1\nFOO 3\n" +
                                                           oldScan("FLASER", {1}, {50, 8, 2}, 103)),
                                 {});
  EXPECT_EQ(stepsOf(*import).size(), 4u);
  ASSERT_EQ(import->warnings().size(), 2u);
  EXPECT_NE(import->warnings()[0].find("3 messages of unknown kind were left out, as 'FOO', 'BAR'"),
            std::string::npos)
      << import->warnings()[0];
  EXPECT_NE(import->warnings()[1].find("1 steps of odometry are over 5 m"), std::string::npos);
  EXPECT_NE(import->warnings()[1].find("103.000000 s"), std::string::npos);
}

TEST(Carmen, RelationsBecomeTheTruth)
{
  const TemporaryFolder folder;
  CarmenOptions options;
  options.relations = folder.write("a.relations", carmenRelations());
  const std::string log = folder.write("a.log", carmenLog());
  const auto import = openCarmen(log, options);
  stepsOf(*import);
  const auto& relations = import->truth().relations;
  ASSERT_EQ(relations.size(), 3u);
  EXPECT_EQ(relations[0].from, 100);
  EXPECT_EQ(relations[0].to, 101.25);
  EXPECT_NEAR(relations[0].pose_from_to.x, 1.994989973, 1e-12);
  EXPECT_EQ(relations[1].pose_from_to.phi, -0.5);
  EXPECT_TRUE(import->warnings().empty());

  folder.write("a.relations", "7 8 0 0 0 0 0 0\n");
  const auto other = openCarmen(log, options);
  stepsOf(*other);
  ASSERT_EQ(other->warnings().size(), 1u);
  EXPECT_NE(other->warnings()[0].find("at which there is no scan"), std::string::npos);
  const auto expectBad =
      [&](const std::string& text, ExitStatus status, const std::vector<std::string>& parts)
  {
    folder.write("a.relations", text);
    expectError(status, parts, [&] { (void)openCarmen(log, options); });
  };
  expectBad("1 2 0 0 0 0 0\n", ExitStatus::kUnreadable, {"line 1", "7 columns instead of 8"});
  expectBad("1 2 0 nan 0 0 0 0\n", ExitStatus::kNonsense, {"line 1", "column dy"});
  expectBad("1 2 0 0 0.5 0 0 0\n", ExitStatus::kNonsense, {"column dz", "plane"});
  expectBad("1 1 0 0 0 0 0 0\n", ExitStatus::kNonsense, {"to itself"});
  expectBad("# none\n", ExitStatus::kUnreadable, {"holds no rows"});
}

TEST(Carmen, TakesPackedLogsAndSaysWhenOneIsCutShort)
{
  const TemporaryFolder folder;
  folder.write("a.log", carmenLog());
  packGz(folder, "a.log");
  EXPECT_EQ(stepsOf(*openCarmen(folder.file("a.log.gz"), {})).size(), 3u);
  const std::string whole = folder.read("a.log.gz");
  folder.write("a.log.gz", whole.substr(0, whole.size() - 9));
  expectError(ExitStatus::kTruncated, {"a.log.gz", "ends early"},
              [&] { stepsOf(*openCarmen(folder.file("a.log.gz"), {})); });
}

void expectFault(const std::string& text, ExitStatus status, const std::vector<std::string>& parts)
{
  SCOPED_TRACE(text.substr(0, 200));
  expectError(status, parts, [&] { importText(text); });
}

TEST(CarmenFaults, AreNamed)
{
  constexpr auto kBad = ExitStatus::kUnreadable;
  constexpr auto kNonsense = ExitStatus::kNonsense;
  std::string still;
  for (int i = 0; i < 101; ++i) still += oldScan("FLASER", {1}, {0, 0, 0}, 7);
  expectFault(still, kNonsense, {"a.log", "over 100 scans", "7.000000 s"});
  expectFault("", kBad, {"a.log", "holds no FLASER"});
  expectFault(
      "\x7f"
      "ELF \x01\x02\n\xff\xfe garbage\n",
      kBad, {"holds no FLASER"});
  expectFault("FLASER\n", kBad, {"line 1", "FLASER has 1 fields"});
  expectFault("FLASER 3 1 2 3 0 0 0 0 0 0 1 host\n", kBad, {"line 1", "3 beams"});
  expectFault("FLASER 2 1 2 3 0 0 0 0 0 0 1 host 0\n", kBad, {"14 fields instead of 13"});
  expectFault("FLASER -1 1 2 3 0 0 0 0 0 0 1 host 0\n", kNonsense, {"field 2", "'-1'"});
  expectFault("FLASER 1e9 1 2 3 0 0 0 0 0 0 1 host 0\n", kBad, {"1000000000 beams"});
  expectFault("FLASER 2 1 nan 0 0 0 0 0 0 1 host 0\n", kNonsense, {"field 4", "'nan'"});
  expectFault("FLASER 2 1 2 0 0 0 0 x 0 1 host 0\n", kBad, {"field 9", "'x' is not a number"});
  expectFault("FLASER 2 1 2 0 0 0 0 0 inf 1 host 0\n", kNonsense, {"field 10"});
  expectFault("FLASER 2 1 2 0 0 0 0 0 0 nan host 0\n", kNonsense, {"field 11"});
  expectFault("ODOM 1 2 3 0 0 0 1 host\n", kBad, {"ODOM has 9 fields instead of 10"});
  const std::string scan = newScan("ROBOTLASER1", "", {0, 0, 0}, {0, 0, 0}, 1);
  expectFault(newScan("ROBOTLASER1", " 7 1", {0, 0, 0}, {0, 0, 0}, 1), kBad, {"ROBOTLASER1"});
  expectFault(newScan("ROBOTLASER1", "", {9, 0, 0}, {0, 0, 0}, 1), kNonsense, {"over 5 m"});
  expectFault("ROBOTLASER1 0 -0.5 0.5 4" + scan.substr(scan.find(" 20 ")), kNonsense,
              {"full turn"});
  expectFault(scan.substr(0, scan.size() / 2) + "\n", kBad, {"ROBOTLASER1"});
}
}  // namespace
}  // namespace slamot::importers
