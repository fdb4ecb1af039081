#include <slamot/core/checkStep.h>

#include "CsvData.h"

namespace slamot::importers
{
namespace
{
using namespace slamot::test;

TEST(CsvFolder, OdometryRowsEndSteps)
{
  const TemporaryFolder folder;
  folder.write("odometry.csv", kOdometryHeader + "0.5,2,0.4,0.1,0.2\n0.75,1,0,0,0\n");
  const auto import = openCsvFolder(folder.file(""));
  EXPECT_EQ(import->starts().time, 0.0);
  EXPECT_FALSE(import->starts().robot);
  const auto steps = stepsOf(*import);
  ASSERT_EQ(steps.size(), 2u);
  EXPECT_EQ(steps[0].time, 0.5);
  EXPECT_EQ(steps[1].time, 0.75);
  const auto first = math::turnThenMove(2, 0.4, 0.5, 0.1, 0.2);
  EXPECT_EQ(steps[0].odometry->mean, first.mean);
  EXPECT_EQ(steps[0].odometry->cov, first.cov);
  EXPECT_EQ(steps[1].odometry->mean, Pose2D(0.25, 0, 0));
  EXPECT_FALSE(steps[0].landmarks || steps[0].blobs);
  EXPECT_EQ(import->counts().steps, 2u);
  EXPECT_EQ(import->counts().end, 0.75);
}

TEST(CsvFolder, IncrementsKeepTheirFrameAndDeviations)
{
  const TemporaryFolder folder;
  folder.write("odometry.csv",
               "t,dx,dy,dphi,std_x,std_y,std_phi\n0.1,1,2,0.3,0.1,0.2,0.3\n0.1,1,0,0,0,0,0.1\n");
  const auto steps = importCsv(folder);
  ASSERT_EQ(steps.size(), 1u) << "rows of one time make one step";
  Gaussian<Pose2D> a, b;
  a.mean = {1, 2, 0.3};
  a.cov = Vector3(0.01, 0.04, 0.09).asDiagonal();
  b.mean = {1, 0, 0};
  b.cov(2, 2) = 0.01;
  const auto sum = math::compose(a, b);
  EXPECT_NEAR(steps[0].odometry->mean.x, sum.mean.x, 1e-12);
  EXPECT_LT((steps[0].odometry->cov - sum.cov).norm(), 1e-12);
}

TEST(CsvFolder, ReportsWithinAStepCutIt)
{
  const TemporaryFolder folder;
  folder.write("odometry.csv", kOdometryHeader + "1,2,0.4,0.1,0.2\n2,2,0.4,0.1,0.2\n");
  folder.write("landmark_sightings.csv", kSightingsHeader +
                                             "0,1,0,0.1,0.01,4\n"
                                             "0.25,3,0.5,0.1,0.01,7\n0.25,4,-0.5,0.2,0.02,-1\n"
                                             "1.0000005,5,0,0.1,0.01,7\n");
  folder.write("blobs.csv", kBlobsHeader +
                                "0.2500004,target,2,0.1,0.1,0.01,1\n"
                                "1.5,target,,0.2,,0.01,-1\n");
  const auto steps = importCsv(folder);
  ASSERT_EQ(steps.size(), 5u);
  const double times[] = {0, 0.25, 1, 1.5, 2};
  Gaussian<Pose2D> sum;
  for (std::size_t i = 0; i < 5; ++i)
  {
    EXPECT_EQ(steps[i].time, times[i]);
    core::checkStep(steps[i], i ? times[i - 1] : 0);
    if (i > 0 && i < 3) sum = math::compose(sum, *steps[i].odometry);
  }
  EXPECT_FALSE(steps[0].odometry) << "before the first motion";
  const auto whole = math::turnThenMove(2, 0.4, 1, 0.1, 0.2);
  EXPECT_NEAR(sum.mean.y, whole.mean.y, 1e-12);
  EXPECT_LT((sum.cov - whole.cov).norm(), 1e-12);
  EXPECT_NEAR(steps[1].odometry->mean.phi, 0.1, 1e-12);
  ASSERT_EQ(steps[1].landmarks->sightings.size(), 2u);
  EXPECT_EQ(steps[1].landmarks->sightings[1].id, core::kNoId);
  EXPECT_EQ(steps[1].blobs->blobs.at(0).id, 1);
  EXPECT_EQ(steps[2].landmarks->sightings.at(0).range, 5);
  EXPECT_FALSE(steps[3].blobs->blobs.at(0).range);
}

TEST(CsvFolder, RowAtTheStartEndsNoStep)
{
  const TemporaryFolder folder;
  folder.write("odometry.csv", kOdometryHeader + "0,2,0.4,0.1,0.2\n1,2,0.4,0.1,0.2\n");
  EXPECT_EQ(importCsv(folder).size(), 1u);
  folder.write(
      "odometry.csv",
      "t,dx,dy,dphi,std_x,std_y,std_phi\n0,0,0,0,0,0,0\n0.1,1,0,0,0,0,0\n0.2,0,0,0,0,0,0\n");
  EXPECT_EQ(importCsv(folder).size(), 2u) << "at rest later on is a step";
  folder.write("odometry.csv", "t,dx,dy,dphi,std_x,std_y,std_phi\n0,1,0,0,0,0,0\n");
  EXPECT_EQ(importCsv(folder).at(0).odometry->mean.x, 1);
}

TEST(CsvFolder, TimesOfAnEpochNeedTheirStart)
{
  const TemporaryFolder folder;
  folder.write("odometry.csv",
               kOdometryHeader + "1700000000.5,2,0,0.1,0.1\n1700000001,2,0,0.1,0.1\n");
  folder.write("blobs.csv", kBlobsHeader + "1700000000,target,2,0,0.1,0.1,1\n");
  const auto import = openCsvFolder(folder.file(""), 1700000000);
  EXPECT_EQ(import->starts().time, 1700000000.0);
  const auto steps = stepsOf(*import);
  ASSERT_EQ(steps.size(), 3u) << "what is seen at the start makes a step without odometry";
  EXPECT_EQ(steps[1].time, 1700000000.5);
  EXPECT_NEAR(steps[1].odometry->mean.x, 1, 1e-9);
  EXPECT_EQ(import->counts().end - import->counts().start, 1);
  EXPECT_TRUE(import->warnings().empty());
}

TEST(CsvFolder, WarnsOfAFirstStepThatIsFarLonger)
{
  const TemporaryFolder folder;
  folder.write("odometry.csv", kOdometryHeader + "12.1,1,0,0,0\n12.2,1,0,0,0\n12.3,1,0,0,0\n");
  auto import = openCsvFolder(folder.file(""));
  stepsOf(*import);
  ASSERT_EQ(import->warnings().size(), 1u);
  EXPECT_NE(import->warnings()[0].find("lasts 12.1 s, from 0 s on, the second 0.1 s"),
            std::string::npos)
      << import->warnings()[0];
  import = openCsvFolder(folder.file(""), 12);
  stepsOf(*import);
  EXPECT_TRUE(import->warnings().empty());
}

TEST(CsvFolder, EmptyScansAreKept)
{
  const TemporaryFolder folder;
  folder.write("odometry.csv", kOdometryHeader + "1,0,0,0,0\n2,0,0,0,0\n");
  folder.write("landmark_sightings.csv", kSightingsHeader + "1,,,,,\n");
  folder.write("blobs.csv", kBlobsHeader + "2,,,,,,\n");
  const auto steps = importCsv(folder);
  ASSERT_EQ(steps.size(), 2u);
  ASSERT_TRUE(steps[0].landmarks && steps[1].blobs);
  EXPECT_TRUE(steps[0].landmarks->sightings.empty() && steps[1].blobs->blobs.empty());
  EXPECT_FALSE(steps[0].blobs || steps[1].landmarks);
}

TEST(CsvFolder, WhatIsOutOfViewIsDroppedAndCounted)
{
  const TemporaryFolder folder;
  folder.write("odometry.csv", kOdometryHeader + "1,0,0,0,0\n");
  folder.write("fov.csv", "range_min,range_max,bearing_min,bearing_max\n0.5,5,-1,1.5\n");
  folder.write("landmark_sightings.csv", kSightingsHeader +
                                             "1,-0.1,0,0.1,0.01,1\n1,0,0,0.1,0.01,1\n"
                                             "1,0.4,0,0.1,0.01,1\n1,5.1,0,0.1,0.01,1\n"
                                             "1,2,-1.2,0.1,0.01,1\n1,2,1.4,0.1,0.01,2\n");
  folder.write("blobs.csv",
               kBlobsHeader + "1,a,,-1.2,,0.01,1\n1,a,,7,,0.01,1\n1,a,6,0,0.1,0.01,1\n");
  const auto import = openCsvFolder(folder.file(""));
  const auto steps = stepsOf(*import);
  ASSERT_EQ(steps.size(), 1u);
  ASSERT_EQ(steps[0].landmarks->sightings.size(), 1u);
  EXPECT_EQ(steps[0].landmarks->sightings[0].id, 2);
  EXPECT_EQ(steps[0].landmarks->fov.bearingMax, 1.5);
  ASSERT_EQ(steps[0].blobs->blobs.size(), 1u);
  EXPECT_NEAR(steps[0].blobs->blobs[0].bearing, 7 - math::kTwoPi, 1e-12);
  EXPECT_EQ(steps[0].dropped, 7);
  EXPECT_EQ(import->counts().outOfView, 7u);
}

TEST(CsvFolder, WhatFollowsTheLastOdometryIsLeftOutAndCounted)
{
  const TemporaryFolder folder;
  folder.write("odometry.csv", kOdometryHeader + "1,0,0,0,0\n");
  folder.write("truth_landmarks.csv", "id,x,y\n1,0,0\n");
  folder.write(
      "landmark_sightings.csv",
      kSightingsHeader + "1,1,0,0.1,0.01,1\n2,1,0,0.1,0.01,1\n2,-1,0,0.1,0.01,1\n3,,,,,\n");
  const auto import = openCsvFolder(folder.file(""));
  EXPECT_EQ(stepsOf(*import).size(), 1u);
  EXPECT_EQ(import->counts().outOfTime, 2u);
  EXPECT_EQ(import->truth().associations.size(), 1u);
}

TEST(CsvFolder, LasersMarkNoReturns)
{
  const TemporaryFolder folder;
  folder.write("odometry.csv", kOdometryHeader + "1,0,0,0,0\n");
  folder.write("scans.csv",
               "t,angle_min,angle_step,range_max,r0,r1,r2,r3,r4\n1,-0.5,0.25,8,1.5,9,0,inf,\n");
  const auto steps = importCsv(folder);
  ASSERT_EQ(steps.size(), 1u);
  const core::LaserScan& scan = *steps[0].lasers.at(0);
  EXPECT_EQ(scan.angleMin, -0.5);
  EXPECT_EQ(scan.angleStep, 0.25);
  ASSERT_EQ(scan.ranges.size(), 5u);
  EXPECT_EQ(scan.ranges[0], 1.5f);
  for (int i = 1; i < 5; ++i) EXPECT_GT(scan.ranges[static_cast<std::size_t>(i)], 8) << i;
}

TEST(CsvFolder, StartsKeepWhatIsUnknown)
{
  const TemporaryFolder folder;
  folder.write("odometry.csv", kOdometryHeader + "1,0,0,0,0\n");
  folder.write("start.csv",
               "object,x,y,theta,vx,vy,ax,ay,std_x,std_y,std_theta,std_vx,std_vy,std_ax,std_ay\n"
               "robot,1,2,0.5,,,,,0.1,0.2,0.3,,,,\ntarget_3,4,5,,1,,,,0,0,,,,,\n");
  const core::Starts starts = openCsvFolder(folder.file(""))->starts();
  EXPECT_EQ(starts.robotPose().mean, Pose2D(1, 2, 0.5));
  EXPECT_DOUBLE_EQ(starts.robotPose().cov(1, 1), 0.04);
  const core::ObjectStart& target = starts.targets.at(3);
  EXPECT_EQ(target.value[core::ObjectStart::kY], 5);
  EXPECT_FALSE(target.value[core::ObjectStart::kTheta]);
  EXPECT_EQ(target.std[core::ObjectStart::kX], 0.0);
  EXPECT_FALSE(target.std[core::ObjectStart::kVx]);
}

TEST(CsvFolder, TruthIsTakenOver)
{
  const TemporaryFolder folder;
  folder.write("odometry.csv", kOdometryHeader + "1,0,0,0,0\n2,0,0,0,0\n");
  folder.write("truth_robot.csv", "t,x,y,theta\n0,1,2,7\n1,3,4,0.5\n");
  folder.write("truth_target_12.csv", "t,x,y,theta\n0.5,1,2,\n");
  folder.write("truth_landmarks.csv", "id,x,y\n4,1,2\n5,3,4\n");
  folder.write("landmark_sightings.csv", kSightingsHeader +
                                             "1,-1,0,0.1,0.01,4\n1,2,0,0.1,0.01,-1\n"
                                             "1,2,0,0.1,0.01,5\n2,2,0,0.1,0.01,99\n2,2,0,1,1,4\n");
  const auto import = openCsvFolder(folder.file(""));
  stepsOf(*import);
  const eval::Truth& truth = import->truth();
  ASSERT_EQ(truth.robot.poses.size(), 2u);
  EXPECT_NEAR(truth.robot.poses[0].pose.phi, 7 - math::kTwoPi, 1e-12);
  EXPECT_FALSE(truth.targets.at(12).poses.at(0).headingKnown);
  EXPECT_EQ(truth.landmarks.at(5), Point2D(3, 4));
  // Places are those in the log, after what was dropped; an id without a true landmark tells
  // nothing.
  ASSERT_EQ(truth.associations.size(), 2u);
  EXPECT_EQ(truth.associations[0].index, 1);
  EXPECT_EQ(truth.associations[0].id, 5);
  EXPECT_EQ(truth.associations[1].time, 2);
  EXPECT_EQ(truth.associations[1].index, 1);
}

TEST(CsvFolder, TakesOtherProgramsHabits)
{
  const TemporaryFolder folder;
  folder.write("odometry.csv",
               "\xEF\xBB\xBFt, v, omega, std_v, std_omega\r\n0.5, +1, 0, 0, 0\r\n\r\n\r\n");
  folder.write("landmark_sightings.csv", kSightingsHeader + "0.5,1,0,0.1,0.01,3.0");
  const auto steps = importCsv(folder);
  ASSERT_EQ(steps.size(), 1u);
  EXPECT_EQ(steps[0].odometry->mean.x, 0.5);
  EXPECT_EQ(steps[0].landmarks->sightings.at(0).id, 3);
}
}  // namespace
}  // namespace slamot::importers
