#include "temporary.h"

#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CRawlog.h>
#include <slamot/core/Error.h>
#include <slamot/mrpt/CObservationColorBlobs.h>
#include <slamot/mrpt/RawlogWriter.h>

namespace
{
using namespace slamot;
using slamot::mrpt::RawlogWriter;
using tests::TemporaryFolder;

core::Step drive(double time)
{
  core::Step step;
  step.time = time;
  step.odometry = math::turnThenMove(0.5, 0.2, 0.1, 0.05, 0.02);
  step.blobs.emplace();
  step.blobs->blobs.push_back({"target", {}, 0.3, 0, 0.01, 4});
  return step;
}

::mrpt::obs::CRawlog load(const std::string& path)
{
  ::mrpt::obs::CRawlog log;
  EXPECT_TRUE(log.loadFromRawLogFile(path));
  return log;
}

TEST(RawlogWriter, MrptReadsPairsWithCovarianceAndComment)
{
  const TemporaryFolder folder;
  core::Starts starts;
  starts.robot.emplace().value[core::ObjectStart::kX] = 1.5;
  RawlogWriter writer(folder.file("a.rawlog"), RawlogWriter::Format::kActionFrames, starts);
  const core::Step step = drive(0.1);
  writer.write(step);
  writer.close();

  const auto log = load(folder.file("a.rawlog"));
  ASSERT_EQ(log.size(), 2u);
  EXPECT_EQ(log.getCommentText(), starts.toIni());
  const auto action = log.getAsAction(0)->getBestMovementEstimation();
  const auto [cov, mean] = action->poseChange->getCovarianceAndMean();
  EXPECT_EQ(mean.asTPose(), step.odometry->mean);
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) EXPECT_EQ(cov(r, c), step.odometry->cov(r, c));
  EXPECT_TRUE(log.getAsObservations(1)->getObservationByClass<obs::CObservationColorBlobs>());
}

TEST(RawlogWriter, ObservationsHoldThePoseBeforeTheFirstIncrement)
{
  const TemporaryFolder folder;
  core::Starts starts;
  starts.time = 0;
  RawlogWriter writer(folder.file("a.rawlog"), RawlogWriter::Format::kObservations, starts);
  writer.write(drive(0.1));
  writer.close();

  const auto log = load(folder.file("a.rawlog"));
  ASSERT_EQ(log.size(), 3u);
  const auto pose = [&](std::size_t i)
  {
    return std::dynamic_pointer_cast<::mrpt::obs::CObservationOdometry>(log.getAsObservation(i))
        ->odometry.asTPose();
  };
  EXPECT_EQ(pose(0), Pose2D());
  EXPECT_EQ(pose(1), drive(0.1).odometry->mean);
}

TEST(RawlogWriter, LeavesNothingWithoutClose)
{
  const TemporaryFolder folder;
  {
    RawlogWriter writer(folder.file("a.rawlog"), RawlogWriter::Format::kActionFrames, {});
    writer.write(drive(0.1));
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(RawlogWriter, RefusesTimeGoingBackwards)
{
  const TemporaryFolder folder;
  RawlogWriter writer(folder.file("a.rawlog"), RawlogWriter::Format::kActionFrames, {});
  writer.write(drive(0.2));
  EXPECT_THROW(writer.write(drive(0.1)), core::Error);
}

TEST(RawlogWriter, NamesAFolderThatIsNotThere)
{
  try
  {
    RawlogWriter("/nonexistent/a.rawlog", RawlogWriter::Format::kActionFrames, {});
    FAIL();
  }
  catch (const core::Error& e)
  {
    EXPECT_EQ(e.status(), core::ExitStatus::kUnreadable);
    EXPECT_NE(std::string(e.what()).find("/nonexistent/a.rawlog"), std::string::npos);
  }
}
}  // namespace
