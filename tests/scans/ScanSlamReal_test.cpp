// Two indoor logs with raw odometry, where the data is at hand.
#include <gtest/gtest.h>
#include <slamot/eval/Evaluation.h>
#include <slamot/eval/Recorder.h>
#include <slamot/importers/Carmen.h>
#include <slamot/scans/ScanSlamFilter.h>

#include <filesystem>

namespace slamot::scans
{
namespace
{
const std::string kFolder = SLAMOT_REAL_DATA "/carmen/";

struct Drive
{
  eval::Trajectory path;
  double entropy = 0, odometryEntropy = 0;
};

Drive driveThrough(importers::Import& import)
{
  core::Config config;
  core::Params params(config, "scan-slam");
  ScanSlamFilter filter(params, {import.starts()});
  eval::Recorder::Options options;
  options.keepLasers = true;
  eval::Recorder recorder(filter, options);
  core::run(import, filter, {&recorder});
  eval::Record record = recorder.takeRecord();
  Drive out;
  std::map<double, Pose2D> poses;
  for (const core::PathPose& p : filter.path())
  {
    out.path.poses.push_back({p.time, p.pose, true});
    poses[p.time] = p.pose;
  }
  for (eval::RobotRow& row : record.rows)
    if (const auto at = poses.find(row.time); at != poses.end()) row.robot.mean = at->second;
  const auto quality = eval::scanMapQuality(record);
  out.entropy = quality->entropy.value();
  out.odometryEntropy = quality->odometryEntropy.value();
  return out;
}

TEST(ScanSlamReal, IntelsLoopsClose)
{
  if (!std::filesystem::exists(kFolder)) GTEST_SKIP() << kFolder << " is not there";
  importers::CarmenOptions options;
  options.relations = kFolder + "intel_relations_first_half.gz";
  const auto import = importers::openCarmen(kFolder + "intel_rawodo.log.gz", options);
  const Drive drive = driveThrough(*import);
  const auto errors = eval::evaluateRelations(drive.path, import->truth().relations);
  ASSERT_TRUE(errors);
  EXPECT_EQ(errors->count, 28);
  EXPECT_LT(errors->translationMean.value(), 0.06);              // odometry 6.83 m
  EXPECT_LT(math::radToDeg(errors->rotationMean.value()), 0.8);  // odometry 50.6 deg
  EXPECT_LT(drive.entropy, drive.odometryEntropy - 0.7);
}

TEST(ScanSlamReal, CsailsMapIsSharp)
{
  if (!std::filesystem::exists(kFolder)) GTEST_SKIP() << kFolder << " is not there";
  const auto import = importers::openCarmen(kFolder + "csail_rawodo.log.gz", {});
  const Drive drive = driveThrough(*import);
  EXPECT_LT(drive.entropy, drive.odometryEntropy - 0.7);
}
}  // namespace
}  // namespace slamot::scans
