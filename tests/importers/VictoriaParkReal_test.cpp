// Dead reckoning of Victoria Park against its GPS fixes, where the data is at hand.
#include <slamot/eval/Alignment.h>
#include <slamot/importers/VictoriaPark.h>

#include <filesystem>

#include "CsvData.h"

namespace slamot::importers
{
namespace
{
using namespace slamot::test;

const std::string kFolder = SLAMOT_REAL_DATA "/victoria_park";

/// The drive as a record of odometry alone, with its truth up to a time.
struct Drive
{
  eval::Record record;
  eval::Truth truth;
  Counts counts;
  int emptyScans = 0;

  explicit Drive(const VictoriaParkOptions& options)
  {
    const auto import = openVictoriaPark(kFolder, options);
    Gaussian<Pose2D> pose;
    while (const auto step = import->next())
    {
      pose = math::compose(pose, *step->odometry);
      eval::RobotRow row;
      row.time = step->time;
      row.robot = pose;
      record.rows.push_back(row);
      emptyScans += step->landmarks && step->landmarks->sightings.empty();
    }
    truth = import->truth();
    counts = import->counts();
  }

  /// Root-mean-square distance to GPS over the first seconds, rigidly aligned on them [m].
  [[nodiscard]] double rmse(double seconds, const Point2D& leverArm) const
  {
    eval::Truth part = truth;
    auto& poses = part.robot.poses;
    while (poses.back().time > seconds) poses.pop_back();
    eval::EvaluationOptions options;
    options.align = eval::Align::kRigid;
    options.leverArm = leverArm;
    return eval::evaluate(record, part, options).robot.all.positionRmse.value();
  }
};

const Point2D kMount(0, 0), kAxle(-3.78, -0.5);

TEST(VictoriaParkReal, DeadReckoningErrsAsTheDataSays)
{
  if (!std::filesystem::exists(kFolder)) GTEST_SKIP() << kFolder << " is not there";
  const Drive logged({});
  EXPECT_NEAR(logged.rmse(120, kAxle), 2.7, 0.1);
  EXPECT_NEAR(logged.rmse(200, kAxle), 14.0, 0.1);
  VictoriaParkOptions offset;
  offset.steeringOffset = 0.010;
  EXPECT_NEAR(Drive(offset).rmse(300, kAxle), 5.1, 0.1);
}

TEST(VictoriaParkReal, CalibrationByTreesHoldsAgainstGps)
{
  if (!std::filesystem::exists(kFolder)) GTEST_SKIP() << kFolder << " is not there";
  VictoriaParkOptions options;  // as doc/importing.md
  options.steeringOffset = math::degToRad(0.25);
  options.steeringScale = 1.03;
  options.laserYaw = math::degToRad(-1.1);
  options.laserDelay = 0.053;
  const Drive drive(options);
  EXPECT_LT(drive.rmse(200, kMount), 4);
  EXPECT_LT(drive.rmse(600, kMount), 10);
  EXPECT_GT(Drive({}).rmse(600, kMount), 30);
}

TEST(VictoriaParkReal, EverythingMeasuredIsDeliveredOrCounted)
{
  if (!std::filesystem::exists(kFolder)) GTEST_SKIP() << kFolder << " is not there";
  const Drive drive({});
  const Counts& c = drive.counts;
  EXPECT_EQ(c.sightings + c.outOfView + c.outOfTime, 52974u);
  EXPECT_EQ(c.outOfView, 0u) << "the field of view holds every tree";
  EXPECT_EQ(c.outOfTime, 8u) << "the first scan, before any odometry";
  EXPECT_EQ(c.landmarkScans, 7248u);
  EXPECT_EQ(drive.emptyScans, 19);
  EXPECT_EQ(drive.truth.robot.poses.size(), 1555u);
  EXPECT_NEAR(c.end - c.start, 1548.6, 1e-6);
}
}  // namespace
}  // namespace slamot::importers
