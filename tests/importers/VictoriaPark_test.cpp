#include "VictoriaParkData.h"

#include <slamot/core/checkStep.h>
#include <slamot/importers/VictoriaPark.h>

#include "CsvData.h"
#include "expectError.h"

namespace slamot::importers
{
namespace
{
using namespace slamot::test;
using core::ExitStatus;

std::vector<core::Step> importPark(const TemporaryFolder& folder,
                                   const VictoriaParkOptions& options = {})
{
  return stepsOf(*openVictoriaPark(folder.file(""), options));
}

Gaussian<Pose2D> total(const std::vector<core::Step>& steps)
{
  Gaussian<Pose2D> sum;
  for (const core::Step& step : steps)
    if (step.odometry) sum = math::compose(sum, *step.odometry);
  return sum;
}

TEST(VictoriaPark, EveryScanEndsAStepAlsoWhereNoTreeWasSeen)
{
  const TemporaryFolder folder;
  writePark(folder);
  const auto import = openVictoriaPark(folder.file(""), {});
  EXPECT_EQ(import->starts().time, 1.0);
  EXPECT_FALSE(import->starts().robot);
  const auto steps = stepsOf(*import);
  ASSERT_EQ(steps.size(), 4u);
  const double times[] = {1.5, 2, 2.5, 3};
  for (std::size_t i = 0; i < 4; ++i)
  {
    core::checkStep(steps[i], i ? times[i - 1] : 1);
    EXPECT_NEAR(steps[i].time, times[i], 1e-9);
    EXPECT_EQ(steps[i].landmarks.has_value(), i < 3);
    EXPECT_TRUE(steps[i].lasers.empty());
  }
  EXPECT_EQ(steps[0].landmarks->sightings.size(), 2u);
  EXPECT_TRUE(steps[1].landmarks->sightings.empty());
  EXPECT_EQ(steps[2].landmarks->sightings.size(), 1u);
  EXPECT_EQ(steps[2].dropped, 2) << "at a negative range, and where the car itself is in the way";
  const Counts& c = import->counts();
  EXPECT_EQ(c.outOfView, 2u);
  EXPECT_EQ(c.outOfTime, 2u) << "before the first and after the last row of odometry";
  EXPECT_EQ(c.sightings, 3u);
  EXPECT_TRUE(import->warnings().empty());
}

TEST(VictoriaPark, WithoutTheLasersFileOnlyTreesTellOfScans)
{
  const TemporaryFolder folder;
  writePark(folder);
  std::filesystem::remove(folder.file("laser_cm.txt"));
  const auto import = openVictoriaPark(folder.file(""), {});
  EXPECT_EQ(stepsOf(*import).size(), 3u);
  ASSERT_EQ(import->warnings().size(), 1u);
  EXPECT_NE(import->warnings()[0].find("without laser_cm.txt"), std::string::npos);
  VictoriaParkOptions options;
  options.lasers = true;
  expectError(ExitStatus::kUnreadable, {"laser_cm.txt"}, [&] { importPark(folder, options); });
}

TEST(VictoriaPark, PathIsThatOfTheLasersMount)
{
  const TemporaryFolder folder;
  writePark(folder);
  const auto steps = importPark(folder);
  const Pose2D straight = math::compose(steps[0].odometry->mean, steps[1].odometry->mean);
  EXPECT_NEAR(straight.x, 2, 1e-9);
  EXPECT_NEAR(straight.y, 0, 1e-12);
  // Then a circle round a point on the rear axle's line: 3.78 m behind, 0.5 m to the right.
  const double radius = 2.83 / std::tan(0.3), turned = 2 / (radius - 0.76);
  const Point2D centre(2 - 3.78, radius - 0.5), from(3.78, 0.5 - radius);
  const Point2D end = math::transform({centre.x, centre.y, turned}, from);
  const Pose2D sum = total(steps).mean;
  EXPECT_NEAR(sum.x, end.x, 1e-9);
  EXPECT_NEAR(sum.y, end.y, 1e-9);
  EXPECT_NEAR(sum.phi, turned, 1e-9);
}

TEST(VictoriaPark, BearingsAreFromAheadAndDeviationsGrowWithRangeAndCloseBy)
{
  const TemporaryFolder folder;
  writePark(folder);
  VictoriaParkOptions options;
  options.trunkStd = 0.3;
  options.rangeScaleStd = 0.02;
  options.bearingStd = 0.04;
  const auto steps = importPark(folder, options);
  const core::Sighting &ahead = steps[0].landmarks->sightings[0],
                       &left = steps[0].landmarks->sightings[1];
  EXPECT_EQ(ahead.id, core::kNoId);
  EXPECT_NEAR(ahead.bearing, 0, 1e-9);
  EXPECT_NEAR(left.bearing, 2.5 - math::kPi / 2, 1e-9);
  EXPECT_EQ(left.range, 20);
  EXPECT_DOUBLE_EQ(left.rangeStd, 0.5);
  EXPECT_DOUBLE_EQ(ahead.bearingStd, 0.05);
  const core::FieldOfView& fov = steps[0].landmarks->fov;
  EXPECT_TRUE(fov.contains(75.3, math::degToRad(-83.5)) && fov.contains(1.48, math::degToRad(87)));
  EXPECT_FALSE(fov.contains(10, math::degToRad(-85)) || fov.contains(10, math::degToRad(89)));
  EXPECT_FALSE(fov.contains(0.83, 0) || fov.contains(81, 0));
}

TEST(VictoriaPark, CalibrationIsAppliedToTheLoggedValues)
{
  const TemporaryFolder folder;
  writePark(folder);
  VictoriaParkOptions options;
  options.steeringOffset = 0.06;
  options.steeringScale = 0.8;  // 0.3 -> 0.3, 0 -> 0.06
  options.laserYaw = 0.1;
  options.laserDelay = 0.2;
  const auto steps = importPark(folder, options);
  ASSERT_EQ(steps.size(), 4u);
  const double times[] = {1.3, 1.8, 2.3, 3.0};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(steps[i].time, times[i], 1e-9);
  const auto turned = [](double steering)
  { return 2 / (2.83 / std::tan(steering) - 0.76); };  // over a second
  EXPECT_NEAR(total(steps).mean.phi, turned(0.06) + turned(0.3), 1e-9);
  EXPECT_NEAR(steps[0].landmarks->sightings[0].bearing, 0.1, 1e-9);
  EXPECT_NEAR(steps[0].landmarks->fov.bearingMax, math::degToRad(87.25) + 0.1, 1e-12);
}

TEST(VictoriaPark, FartherTreesAreLeftOutWhereAsked)
{
  const TemporaryFolder folder;
  writePark(folder);
  VictoriaParkOptions options;
  options.maxRange = 15;
  const auto steps = importPark(folder, options);
  EXPECT_EQ(steps[0].landmarks->sightings.size(), 1u);
  EXPECT_EQ(steps[0].dropped, 1);
  EXPECT_EQ(steps[0].landmarks->fov.rangeMax, 15);
}

TEST(VictoriaPark, LaserScansComeWhereAsked)
{
  const TemporaryFolder folder;
  writePark(folder);
  std::vector<double> row(362, 1234);
  row[0] = 1.5, row[1] = 83, row[2] = 8000, row[3] = 7999, row[361] = 8191;
  folder.write("laser_cm.txt", parkRow(row));
  VictoriaParkOptions options;
  options.lasers = true;
  options.laserYaw = -0.02;
  const auto steps = importPark(folder, options);
  ASSERT_EQ(steps[0].lasers.size(), 1u);
  const core::LaserScan& scan = *steps[0].lasers[0];
  EXPECT_EQ(scan.pose_robot_sensor, Pose2D(0, 0, -0.02));
  EXPECT_NEAR(scan.angleMin, -math::kPi / 2, 1e-12);
  EXPECT_NEAR(scan.angleMin + 360 * scan.angleStep, math::kPi / 2, 1e-12);
  ASSERT_EQ(scan.ranges.size(), 361u);
  EXPECT_GT(scan.ranges[0], scan.rangeMax) << "the car itself";
  EXPECT_GT(scan.ranges[1], scan.rangeMax);
  EXPECT_EQ(scan.ranges[2], 79.99f);
  EXPECT_EQ(scan.ranges[3], 12.34f);
  EXPECT_GT(scan.ranges[360], scan.rangeMax);
}

TEST(VictoriaPark, TruthIsTheFixesWithoutHeading)
{
  const TemporaryFolder folder;
  writePark(folder);
  const auto import = openVictoriaPark(folder.file(""), {});
  stepsOf(*import);
  const auto& poses = import->truth().robot.poses;
  ASSERT_EQ(poses.size(), 3u);
  EXPECT_EQ(poses[1].time, 1.2);
  EXPECT_EQ(poses[1].pose, Pose2D(11, 20.5, 0));
  for (const auto& pose : poses) EXPECT_FALSE(pose.headingKnown);
  std::filesystem::remove(folder.file("gps_first_600s.txt"));
  EXPECT_TRUE(openVictoriaPark(folder.file(""), {})->truth().robot.empty());
}

TEST(VictoriaPark, TakesPackedFilesAndSaysWhenOneIsCutShort)
{
  const TemporaryFolder folder;
  writePark(folder);
  const auto plain = importPark(folder);
  const std::vector<std::string> names = {"inputs.txt", "trees.txt", "laser_cm.txt",
                                          "gps_first_600s.txt"};
  for (const std::string& name : names) packGz(folder, name);
  const auto packed = importPark(folder);
  ASSERT_EQ(packed.size(), plain.size());
  EXPECT_EQ(total(packed).mean, total(plain).mean);
  for (const std::string& name : names)
  {
    const std::string whole = folder.read(name + ".gz");
    folder.write(name + ".gz", whole.substr(0, whole.size() - 9));
    expectError(ExitStatus::kTruncated, {name + ".gz", "ends early"}, [&] { importPark(folder); });
    folder.write(name + ".gz", whole);
  }
}

/// A sound folder with one file replaced; its import must fail as said.
void expectFault(const std::string& file, const std::string& text, ExitStatus status,
                 const std::vector<std::string>& parts)
{
  SCOPED_TRACE(file + ":\n" + text.substr(0, 200));
  const TemporaryFolder folder;
  writePark(folder);
  folder.write(file, text);
  expectError(status, parts, [&] { importPark(folder); });
}

constexpr auto kBad = ExitStatus::kUnreadable;
constexpr auto kNonsense = ExitStatus::kNonsense;

TEST(VictoriaParkFaults, OfInputsAreNamed)
{
  const std::string file = "inputs.txt";
  expectFault(file, "1 2 0\n1.025 nan 0\n", kNonsense, {file + " line 2", "column speed"});
  expectFault(file, "1 2 0\n1.025 2 inf\n", kNonsense, {"line 2", "column steering"});
  expectFault(file, "1 2 0\n1.025 2\n", kBad, {"line 2", "2 columns instead of 3"});
  expectFault(file, "1 2 0\n1.025 2 x\n", kBad, {"line 2", "'x' is not a number"});
  expectFault(file, "1 2 0\n0.9 2 0\n", kNonsense, {"line 2", "backwards"});
  expectFault(file, "1 2 0\n2.1 2 0\n", kNonsense, {"line 2", "over 1 s"});
  expectFault(file, "1 2 0\n1.1 51 0\n", kNonsense, {"line 2", "speed"});
  expectFault(file, "1 2 17\n", kNonsense, {"line 1", "steering", "radians"});
  expectFault(file, "1 2 0\n\n1.1 2 0\n", kBad, {"blank line"});
  expectFault(file, "", kBad, {file, "holds no rows"});
  expectFault(file, "# time\n", kBad, {file, "holds no rows"});
}

TEST(VictoriaParkFaults, OfTreesLasersAndFixesAreNamed)
{
  std::string file = "trees.txt";
  expectFault(file, "1.5 nan 1 0.2\n", kNonsense, {file + " line 1", "column range"});
  expectFault(file, "1.5 9 1 -0.2\n", kNonsense, {"column diameter", "negative"});
  expectFault(file, "1.5 9 1\n", kBad, {"3 columns instead of 4"});
  expectFault(file, "1.5 9 1 0.2\n1.4 9 1 0.2\n", kNonsense, {"line 2", "backwards"});
  expectFault(file, "9 9 1 0.2\n9 x 1 0.2\n", kBad, {"line 2"});
  expectFault(file, "", kBad, {"holds no rows"});
  std::string crowd;
  for (int i = 0; i < 362; ++i) crowd += "1.5 9 1 0.2\n";
  expectFault(file, crowd, kNonsense, {"more trees at one time"});
  file = "laser_cm.txt";
  expectFault(file, parkLaserRow(1.5, -1), kNonsense, {file + " line 1", "column r0"});
  expectFault(file, "1.5 7 7\n", kBad, {"3 columns instead of 362"});
  expectFault(file, parkLaserRow(1.5, 7) + parkLaserRow(1.4, 7), kNonsense, {"backwards"});
  expectFault(file, "", kBad, {"holds no rows"});
  file = "gps_first_600s.txt";
  expectFault(file, "1 0 0\n1 0 0\n", kNonsense, {file + " line 2", "does not rise"});
  expectFault(file, "1 0 nan\n", kNonsense, {"column north"});
  expectFault(file, "", kBad, {"holds no rows"});
}

TEST(VictoriaParkFaults, OfTheFolderAndTheOptionsAreNamed)
{
  const TemporaryFolder folder;
  expectError(kBad, {"inputs.txt", "neither this nor its .gz"}, [&] { importPark(folder); });
  writePark(folder);
  std::filesystem::remove(folder.file("trees.txt"));
  expectError(kBad, {"trees.txt", "neither this nor its .gz"}, [&] { importPark(folder); });
  VictoriaParkOptions exact;
  exact.trunkStd = exact.bearingStd = 0;
  expectError(ExitStatus::kConfig, {"--std-bearing", "above zero"},
              [&] { importPark(folder, exact); });
}
}  // namespace
}  // namespace slamot::importers
