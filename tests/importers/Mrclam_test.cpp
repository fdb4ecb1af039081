#include <slamot/core/checkStep.h>

#include "CsvData.h"
#include "MrclamData.h"
#include "expectError.h"

namespace slamot::importers
{
namespace
{
using namespace slamot::test;
using core::ExitStatus;

MrclamOptions robot(int number)
{
  MrclamOptions out;
  out.robot = number;
  return out;
}

Gaussian<Pose2D> total(const std::vector<core::Step>& steps)
{
  Gaussian<Pose2D> sum;
  for (const core::Step& step : steps) sum = math::compose(sum, *step.odometry);
  return sum;
}

TEST(Mrclam, VelocityIsHeldUntilTheNextRow)
{
  const TemporaryFolder folder;
  writeMrclam(folder);
  for (const double maxStep : {0.05, 0.1, 10.0})
  {
    MrclamOptions options = robot(1);
    options.maxStep = maxStep;
    const Pose2D end = total(stepsOf(*openMrclam(folder.file(""), options))).mean;
    // One second on a circle of radius 0.5 m, one second straight on at 0.2 m/s.
    EXPECT_NEAR(end.x, 0.5 * std::sin(1.0) + 0.2 * std::cos(1.0), 1e-9) << maxStep;
    EXPECT_NEAR(end.y, 0.5 * (1 - std::cos(1.0)) + 0.2 * std::sin(1.0), 1e-9) << maxStep;
    EXPECT_NEAR(end.phi, 1.0, 1e-9) << maxStep;
  }
}

TEST(Mrclam, UncertaintyIsThatOfTheNoiseWhateverTheSteps)
{
  const TemporaryFolder folder;
  writeMrclam(folder);
  MrclamOptions options = robot(1);
  options.wheels = {0.01, 0, 0.02, 0.1};
  for (const double maxStep : {0.05, 10.0})
  {
    options.maxStep = maxStep;
    const Matrix3 cov = total(stepsOf(*openMrclam(folder.file(""), options))).cov;
    EXPECT_NEAR(cov(2, 2), 2 * 0.02 * 0.02 + 1.0 * 0.1 * 0.1, 1e-12);
  }
  options.wheels = {0.01, 0.03, 0, 0};
  const Matrix3 cov = total(stepsOf(*openMrclam(folder.file(""), options))).cov;
  EXPECT_NEAR(cov.trace(), 2 * 0.01 * 0.01 + 1.0 * 0.03 * 0.03, 1e-12);
}

TEST(Mrclam, EveryImageEndsAStepAndNoStepIsLong)
{
  const TemporaryFolder folder;
  writeMrclam(folder);
  const auto import = openMrclam(folder.file(""), robot(1));
  EXPECT_EQ(import->starts().time, 1000.0);
  const auto steps = stepsOf(*import);
  double last = 1000;
  std::vector<double> images;
  for (const core::Step& step : steps)
  {
    core::checkStep(step, last);
    EXPECT_GT(step.time, last);
    EXPECT_LE(step.time - last, 0.1 + 1e-4);
    last = step.time;
    if (step.landmarks) images.push_back(step.time);
  }
  EXPECT_EQ(last, 1002);
  EXPECT_EQ(images, (std::vector<double>{1000.25, 1001.5}));
  EXPECT_EQ(steps.size(), 3u + 13u + 5u);
}

TEST(Mrclam, BarcodesTellLandmarksFromRobots)
{
  const TemporaryFolder folder;
  writeMrclam(folder);
  for (const bool ids : {true, false})
  {
    MrclamOptions options = robot(1);
    options.landmarkIds = options.targetIds = ids;
    options.rangeStd = 0.3;
    options.rangeScaleStd = 0.2;
    const auto import = openMrclam(folder.file(""), options);
    const auto steps = stepsOf(*import);
    const core::Step& first = steps.at(2);
    ASSERT_EQ(first.landmarks->sightings.size(), 1u);
    const core::Sighting& sighting = first.landmarks->sightings[0];
    EXPECT_EQ(sighting.id, ids ? 6 : core::kNoId);
    EXPECT_EQ(sighting.range, 2.0);
    EXPECT_EQ(sighting.bearing, 0.1);
    EXPECT_DOUBLE_EQ(sighting.rangeStd, 0.5);
    ASSERT_EQ(first.blobs->blobs.size(), 1u);
    EXPECT_EQ(first.blobs->blobs[0].label, "robot");
    EXPECT_EQ(first.blobs->blobs[0].id, ids ? 2 : core::kNoId);
    EXPECT_TRUE(first.landmarks->fov.contains(3.0, -0.2));
    EXPECT_FALSE(first.landmarks->fov.contains(3.1, 0));
    // An unknown barcode and its own; a negative range; before and after the odometry.
    EXPECT_EQ(import->counts().unknown, 2u);
    EXPECT_EQ(import->counts().outOfView, 1u);
    EXPECT_EQ(import->counts().outOfTime, 2u);
    const auto& seen = import->truth().associations;
    ASSERT_EQ(seen.size(), 2u);
    EXPECT_EQ(seen[0].id, 6);
    EXPECT_EQ(seen[1].id, 7);
    EXPECT_EQ(seen[1].time, 1001.5);
  }
}

TEST(Mrclam, TruthHasTheStepsTimesButNoneInGaps)
{
  const TemporaryFolder folder;
  writeMrclam(folder);
  const auto import = openMrclam(folder.file(""), robot(1));
  const core::Starts starts = import->starts();
  EXPECT_NEAR(starts.robotPose().mean.x, 0.5, 1e-6);
  EXPECT_NEAR(starts.robotPose().mean.phi, math::wrapToPi(3.15), 1e-6);
  EXPECT_GT(starts.robotPose().cov(0, 0), 0);
  const auto steps = stepsOf(*import);
  const eval::Truth& truth = import->truth();
  EXPECT_EQ(truth.landmarks.at(6), Point2D(1.5, 2.5));
  std::size_t matched = 0;
  for (const core::Step& step : steps)
  {
    const bool gap = step.time > 1000.5 + 1e-6 && step.time < 1001.2 - 1e-6;
    const auto pose = truth.robot.at(step.time, 1e-9);
    EXPECT_EQ(pose.has_value(), !gap) << step.time;
    if (!pose) continue;
    ++matched;
    EXPECT_NEAR(pose->pose.x, step.time - 999.5, 1e-6);
  }
  EXPECT_EQ(truth.robot.poses.size(), matched + 1) << "the start as well";
  const eval::Trajectory& other = truth.targets.at(2);
  EXPECT_GE(other.poses.front().time, 1000.1);
  EXPECT_LE(other.poses.back().time, 1000.4);
  EXPECT_FALSE(truth.targets.count(1));
}

/// The labels and identities of all blobs, in order.
std::vector<std::string> blobsOf(const std::vector<core::Step>& steps)
{
  std::vector<std::string> out;
  for (const core::Step& step : steps)
    if (step.blobs)
      for (const core::Blob& b : step.blobs->blobs)
        out.push_back(b.label + " " + std::to_string(b.id));
  return out;
}

TEST(Mrclam, ATeamsTargetIsToldFromTeamMates)
{
  const TemporaryFolder folder;
  writeMrclamTeam(folder);
  for (const bool ids : {true, false})
  {
    MrclamOptions options = robot(1);
    options.target = 2;
    options.targetIds = ids;
    const auto import = openMrclam(folder.file(""), options);
    EXPECT_EQ(blobsOf(stepsOf(*import)),
              (std::vector<std::string>{ids ? "robot 3" : "robot -1", "target 2"}));
    EXPECT_EQ(import->truth().targets.size(), 1u) << "mates are none";
    EXPECT_EQ(import->truth().targets.count(2), 1u);
    EXPECT_FALSE(import->truth().robot.empty());
  }
  EXPECT_EQ(mrclamTeam(2), (std::vector<int>{1, 3, 4, 5}));
}

TEST(Mrclam, HiddenLandmarksLeaveAllElse)
{
  const TemporaryFolder folder;
  writeMrclamTeam(folder);
  MrclamOptions options = robot(1);
  const auto plain = openMrclam(folder.file(""), options);
  options.hideLandmarks = true;
  const auto hidden = openMrclam(folder.file(""), options);
  const auto a = stepsOf(*plain), b = stepsOf(*hidden);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    EXPECT_EQ(a[i].time, b[i].time);
    EXPECT_EQ(a[i].odometry->mean, b[i].odometry->mean);
    EXPECT_FALSE(b[i].landmarks);
    EXPECT_EQ(a[i].blobs.has_value(), b[i].blobs.has_value());
  }
  EXPECT_EQ(blobsOf(a), blobsOf(b));
  EXPECT_GT(plain->counts().sightings, 0u);
  EXPECT_EQ(hidden->counts().hidden, plain->counts().sightings);
  EXPECT_EQ(hidden->counts().sightings, 0u);
  EXPECT_TRUE(hidden->truth().associations.empty());
}

TEST(Mrclam, DelayShiftsOdometry)
{
  const TemporaryFolder folder;
  writeMrclam(folder);
  MrclamOptions options = robot(1);
  options.odometryDelay = 0.5;
  options.startFromTruth = false;
  const auto import = openMrclam(folder.file(""), options);
  EXPECT_EQ(import->starts().time, 1000.5);
  EXPECT_FALSE(import->starts().robot);
  const auto steps = stepsOf(*import);
  EXPECT_EQ(steps.back().time, 1002.5);
  EXPECT_NEAR(total(steps).mean.phi, 1.0, 1e-9);
}

TEST(Mrclam, FaultsAreNamed)
{
  const auto expectFault = [](const std::string& file, const std::string& text, ExitStatus status,
                              const std::vector<std::string>& parts)
  {
    const TemporaryFolder folder;
    writeMrclam(folder);
    folder.write(file, text);
    expectError(status, parts, [&] { stepsOf(*openMrclam(folder.file(""), robot(1))); });
  };
  const std::string odometry = "Robot1_Odometry.dat";
  expectFault(odometry, "2 0 0\n1 0 0\n", ExitStatus::kNonsense,
              {odometry + " line 2", "backwards"});
  expectFault(odometry, "1 nan 0\n", ExitStatus::kNonsense, {"column v"});
  expectFault(odometry, "1 0\n", ExitStatus::kUnreadable, {"2 columns instead of 3"});
  expectFault(odometry, "# only\n", ExitStatus::kUnreadable, {"no rows"});
  expectFault("Robot1_Measurement.dat", "1 x 1 1\n", ExitStatus::kUnreadable, {"column barcode"});
  expectFault("Barcodes.dat", "1 5\n2 5\n", ExitStatus::kNonsense, {"line 2", "twice"});
  expectFault("Robot1_Groundtruth.dat", "# none\n", ExitStatus::kUnreadable, {"--start origin"});
  const TemporaryFolder folder;
  writeMrclam(folder);
  expectError(ExitStatus::kUnreadable, {"Robot2_Odometry.dat"},
              [&] { openMrclam(folder.file(""), robot(2)); });
  expectError(ExitStatus::kConfig, {"robots 1 to 5"},
              [&] { openMrclam(folder.file(""), robot(6)); });
  MrclamOptions own = robot(1);
  own.target = 1;
  expectError(ExitStatus::kConfig, {"--target", "is the robot itself"},
              [&] { openMrclam(folder.file(""), own); });
  expectError(ExitStatus::kConfig, {"--target", "robots 1 to 5"}, [&] { mrclamTeam(0); });
}
}  // namespace
}  // namespace slamot::importers
