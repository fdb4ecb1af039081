// Dead reckoning of the scaled cars against motion capture, where the data is at hand.
#include <slamot/importers/ScaledCars.h>

#include <Eigen/Dense>
#include <filesystem>

#include "CsvData.h"

namespace slamot::importers
{
namespace
{
using namespace slamot::test;

const std::string kFolder = SLAMOT_REAL_DATA "/scaled_cars/";
const std::vector<std::string> kRuns = {"overtakes", "parallel_a", "two_robots"};

struct Drive
{
  std::vector<core::Step> steps;
  core::Starts starts;
  eval::Truth truth;
  Counts counts;
  std::size_t warnings = 0;

  explicit Drive(const std::string& run, const ScaledCarsOptions& options = {})
  {
    const auto import = openScaledCars(kFolder + run, options);
    steps = stepsOf(*import);
    starts = import->starts();
    truth = import->truth();
    counts = import->counts();
    warnings = import->warnings().size();
  }

  /// Root-mean-square distance of dead reckoning from the truth [m].
  [[nodiscard]] double rmse() const
  {
    Gaussian<Pose2D> pose = starts.robotPose();
    double sum = 0;
    int n = 0;
    for (const core::Step& step : steps)
    {
      if (step.odometry) pose = math::compose(pose, *step.odometry);
      const auto truly = truth.robot.at(step.time, 0.2);
      if (!truly) continue;
      sum += std::pow(pose.mean.x - truly->pose.x, 2) + std::pow(pose.mean.y - truly->pose.y, 2);
      ++n;
    }
    return std::sqrt(sum / n);
  }
};

/// Normalised errors of dead reckoning over windows of a drive, each from the true pose.
void addNormalisedErrors(const Drive& d, double window, Vector3& sums, double& nees, int& n)
{
  double next = 0;
  for (std::size_t i = 0; i < d.steps.size(); ++i)
  {
    const double begin = d.steps[i].time;
    const auto from = d.truth.robot.at(begin, 0.2);
    if (begin < next || !from) continue;
    next = begin + 0.5;
    Gaussian<Pose2D> pose;
    pose.mean = from->pose;
    pose.cov(2, 2) = 0.01 * 0.01;  // of the truth's heading, as at the log's start
    std::size_t j = i;
    double driven = 0;
    while (j + 1 < d.steps.size() && d.steps[j].time < begin + window)
    {
      pose = math::compose(pose, *d.steps[++j].odometry);
      driven += std::hypot(d.steps[j].odometry->mean.x, d.steps[j].odometry->mean.y);
    }
    const auto to = d.truth.robot.at(d.steps[j].time, 0.2);
    if (!to || d.steps[j].time < begin + window || driven < 0.1) continue;
    const Pose2D off = math::between(to->pose, pose.mean);
    const Matrix3 r = math::poseRotation(-to->pose.phi);
    const Vector3 floor(1e-5, 1e-5, 1e-6);  // truth's own noise
    const Matrix3 cov = r * pose.cov * r.transpose() + Matrix3(floor.asDiagonal());
    const Vector3 e(off.x, off.y, off.phi);
    nees += math::mahalanobisSquared(e, cov);
    sums += e.cwiseAbs2().cwiseQuotient(cov.diagonal());
    ++n;
  }
}

TEST(ScaledCarsReal, DeadReckoningErrsByATenthOfAMetre)
{
  if (!std::filesystem::exists(kFolder)) GTEST_SKIP() << kFolder << " is not there";
  ScaledCarsOptions wheels;
  wheels.heading = ScaledCarsOptions::Heading::kWheels;
  for (const std::string& run : kRuns)
  {
    SCOPED_TRACE(run);
    const Drive drive(run);
    EXPECT_LT(drive.rmse(), 0.13);
    EXPECT_GT(Drive(run, wheels).rmse(), drive.rmse()) << "the gyro is the better one";
  }
}

TEST(ScaledCarsReal, OdometryErrsAsItsCovarianceSays)
{
  if (!std::filesystem::exists(kFolder)) GTEST_SKIP() << kFolder << " is not there";
  const std::vector<Drive> drives(kRuns.begin(), kRuns.end());
  for (const double window : {1.0, 2.0, 5.0, 10.0, 20.0})
  {
    Vector3 sums(0, 0, 0);
    double nees = 0;
    int n = 0;
    for (const Drive& drive : drives) addNormalisedErrors(drive, window, sums, nees, n);
    nees /= 3 * n;
    sums /= n;
    RecordProperty("window_" + std::to_string(static_cast<int>(window)), std::to_string(nees));
    std::printf("%2.0f s: %d windows, NEES / 3 %.2f, along %.2f, across %.2f, heading %.2f\n",
                window, n, nees, sums[0], sums[1], sums[2]);
    EXPECT_LT(nees, 1.3) << window << " s";
    EXPECT_GT(nees, 0.2) << window << " s";
  }
}

TEST(ScaledCarsReal, EverythingIsDeliveredOrCounted)
{
  if (!std::filesystem::exists(kFolder)) GTEST_SKIP() << kFolder << " is not there";
  const std::size_t scans[] = {339, 219, 388}, targets[] = {1, 1, 2};
  for (std::size_t i = 0; i < 3; ++i)
  {
    SCOPED_TRACE(kRuns[i]);
    const Drive drive(kRuns[i]);
    EXPECT_EQ(drive.counts.lasers + drive.counts.outOfTime, scans[i]);
    EXPECT_LE(drive.counts.outOfTime, 16u);
    EXPECT_EQ(drive.truth.targets.size(), targets[i]);
    EXPECT_GE(drive.truth.robot.poses.size(), drive.counts.steps - 2);
    EXPECT_EQ(drive.warnings, i == 2 ? 1u : 0u) << "target 2's heading is not that of its driving";
  }
}
}  // namespace
}  // namespace slamot::importers
