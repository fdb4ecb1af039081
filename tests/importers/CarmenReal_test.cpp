// Two CARMEN logs with raw odometry, where the data is at hand.
#include <slamot/eval/Evaluation.h>
#include <slamot/importers/Carmen.h>

#include <filesystem>

#include "CsvData.h"

namespace slamot::importers
{
namespace
{
using namespace slamot::test;

const std::string kFolder = SLAMOT_REAL_DATA "/carmen/";

/// Odometry summed up.
eval::Trajectory pathOf(Import& import)
{
  eval::Trajectory out;
  Gaussian<Pose2D> pose;
  for (const core::Step& step : stepsOf(import))
  {
    if (step.odometry) pose = math::compose(pose, *step.odometry);
    out.poses.push_back({step.time, pose.mean, true});
  }
  return out;
}

double lengthOf(const eval::Trajectory& path)
{
  double sum = 0;
  for (std::size_t i = 1; i < path.poses.size(); ++i)
  {
    const Pose2D step = math::between(path.poses[i - 1].pose, path.poses[i].pose);
    sum += std::hypot(step.x, step.y);
  }
  return sum;
}

TEST(CarmenReal, IntelsRawOdometryErrsAsItsRelationsSay)
{
  if (!std::filesystem::exists(kFolder)) GTEST_SKIP() << kFolder << " is not there";
  CarmenOptions options;
  options.relations = kFolder + "intel_relations_first_half.gz";
  const auto import = openCarmen(kFolder + "intel_rawodo.log.gz", options);
  const eval::Trajectory path = pathOf(*import);
  EXPECT_EQ(import->counts().lasers, 910u);
  EXPECT_NEAR(lengthOf(path), 501, 1);
  ASSERT_EQ(import->truth().relations.size(), 1500u);
  const auto errors = eval::evaluateRelations(path, import->truth().relations);
  ASSERT_TRUE(errors);
  EXPECT_EQ(errors->count, 28);
  EXPECT_NEAR(errors->translationMean.value(), 6.835, 0.001);
  EXPECT_NEAR(math::radToDeg(errors->rotationMean.value()), 50.55, 0.01);
  EXPECT_TRUE(import->warnings().empty());
}

TEST(CarmenReal, OdomLinesTellTheSamePath)
{
  if (!std::filesystem::exists(kFolder)) GTEST_SKIP() << kFolder << " is not there";
  const std::string log = kFolder + "csail_rawodo.log.gz";
  CarmenOptions options;
  const auto scans = openCarmen(log, options);
  options.odometryLines = true;
  const auto lines = openCarmen(log, options);
  const eval::Trajectory a = pathOf(*scans), b = pathOf(*lines);
  EXPECT_NEAR(lengthOf(a), 371, 1);
  EXPECT_EQ(scans->counts().lasers, 406u);
  ASSERT_EQ(a.poses.size(), b.poses.size());
  for (std::size_t i = 0; i < a.poses.size(); ++i) EXPECT_EQ(a.poses[i].pose, b.poses[i].pose);
}
}  // namespace
}  // namespace slamot::importers
