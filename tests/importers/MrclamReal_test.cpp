// Dead reckoning of dataset 6 against its truth, where the data is at hand.
#include <Eigen/Dense>
#include <filesystem>

#include "CsvData.h"
#include "MrclamData.h"

namespace slamot::importers
{
namespace
{
using namespace slamot::test;

const std::string kFolder = SLAMOT_REAL_DATA "/mrclam/dataset6";
constexpr double kTruthGap = 0.5;  // [s]

struct Drive
{
  std::vector<core::Step> steps;
  core::Starts starts;
  eval::Truth truth;
  Counts counts;
};

const Drive& drive(int robot)
{
  static std::map<int, Drive> drives;
  const auto [place, isNew] = drives.try_emplace(robot);
  Drive& out = place->second;
  if (!isNew) return out;
  MrclamOptions options;
  options.robot = robot;
  const auto import = openMrclam(kFolder, options);
  out.steps = stepsOf(*import);
  out.starts = import->starts();
  out.truth = import->truth();
  out.counts = import->counts();
  return out;
}

double rmsError(const Drive& d, double seconds)
{
  Gaussian<Pose2D> pose = d.starts.robotPose();
  double sum = 0;
  int n = 0;
  for (const core::Step& step : d.steps)
  {
    if (step.time > *d.starts.time + seconds) break;
    pose = math::compose(pose, *step.odometry);
    if (const auto truth = d.truth.robot.at(step.time, kTruthGap))
    {
      sum += std::pow(pose.mean.x - truth->pose.x, 2) + std::pow(pose.mean.y - truth->pose.y, 2);
      ++n;
    }
  }
  return std::sqrt(sum / n);
}

/// Adds the normalised errors of dead reckoning over windows of the drive, from the true pose.
void addNormalisedErrors(const Drive& d, double window, double& sum, int& n)
{
  double next = 0;
  for (std::size_t i = 0; i < d.steps.size(); ++i)
  {
    const double begin = d.steps[i].time;
    const auto from = d.truth.robot.at(begin, kTruthGap);
    if (begin < next || !from) continue;
    next = begin + std::max(0.5, window / 4);
    Gaussian<Pose2D> pose;
    pose.mean = from->pose;
    pose.cov(2, 2) = 0.015 * 0.015;  // between truth's heading and the direction of driving
    std::size_t j = i;
    while (j + 1 < d.steps.size() && d.steps[j].time < begin + window)
      pose = math::compose(pose, *d.steps[++j].odometry);
    const auto to = d.truth.robot.at(d.steps[j].time, kTruthGap);
    if (!to || d.steps[j].time < begin + window) continue;
    const Vector3 e(pose.mean.x - to->pose.x, pose.mean.y - to->pose.y,
                    math::wrapToPi(pose.mean.phi - to->pose.phi));
    const Matrix3 floor = Vector3::Constant(1e-6).asDiagonal();  // truth's own noise
    sum += math::mahalanobisSquared(e, pose.cov + floor);
    ++n;
  }
}

TEST(MrclamReal, DeadReckoningErrsAsPublishedAndAsItsCovarianceSays)
{
  if (!std::filesystem::exists(kFolder)) GTEST_SKIP() << kFolder << " is not there";
  const double windows[] = {1, 3, 10, 30};
  double sums[4] = {};
  int counts[4] = {};
  for (int robot = 1; robot <= 5; ++robot)
  {
    const Drive& d = drive(robot);
    EXPECT_GT(rmsError(d, 60), 0.11) << robot;
    EXPECT_LT(rmsError(d, 60), 0.59) << robot;
    EXPECT_GT(rmsError(d, 300), 0.5) << robot;
    EXPECT_LT(rmsError(d, 300), 1.25) << robot;
    EXPECT_GT(rmsError(d, 900), 1.7) << robot;
    EXPECT_LT(rmsError(d, 900), 4.3) << robot;
    for (int i = 0; i < 4; ++i) addNormalisedErrors(d, windows[i], sums[i], counts[i]);
  }
  for (int i = 0; i < 4; ++i)
  {
    const double nees = sums[i] / counts[i] / 3;
    EXPECT_GT(nees, 0.8) << windows[i] << " s";
    EXPECT_LT(nees, 1.2) << windows[i] << " s";
  }
}

std::size_t outOfView(const Drive& d)
{
  std::size_t n = 0;
  for (const core::Step& step : d.steps)
  {
    if (!step.landmarks) continue;
    for (const core::Sighting& s : step.landmarks->sightings)
      n += !step.landmarks->fov.contains(s.range, s.bearing);
  }
  return n;
}

TEST(MrclamReal, EverythingMeasuredIsDeliveredOrCounted)
{
  if (!std::filesystem::exists(kFolder)) GTEST_SKIP() << kFolder << " is not there";
  const std::size_t rows[] = {1942, 4031, 5627, 2399, 5378};
  for (int robot = 1; robot <= 5; ++robot)
  {
    const Drive& d = drive(robot);
    const Counts& c = d.counts;
    EXPECT_EQ(c.sightings + c.blobs + c.unknown + c.outOfView + c.outOfTime, rows[robot - 1]);
    EXPECT_LE(c.unknown, 3u);
    EXPECT_EQ(c.outOfTime + c.outOfView, 0u);
    EXPECT_EQ(d.truth.associations.size(), c.sightings);
    EXPECT_EQ(d.truth.landmarks.size(), 15u);
    EXPECT_EQ(d.truth.targets.size(), 4u);
    EXPECT_EQ(outOfView(d), 0u);
  }
}

TEST(MrclamReal, ATeamSeesItsTargetAndItsMates)
{
  if (!std::filesystem::exists(kFolder)) GTEST_SKIP() << kFolder << " is not there";
  std::size_t targets = 0;
  for (const int robot : mrclamTeam(5))
  {
    MrclamOptions options;
    options.robot = robot;
    options.target = 5;
    options.targetIds = false;
    const auto import = openMrclam(kFolder, options);
    std::size_t blobs = 0;
    for (const core::Step& step : stepsOf(*import))
      for (const core::Blob& b : step.blobs ? step.blobs->blobs : std::vector<core::Blob>())
      {
        ++blobs;
        targets += b.label == "target";
        EXPECT_EQ(b.id, b.label == "target" ? 5 : core::kNoId);
      }
    EXPECT_EQ(blobs, drive(robot).counts.blobs);
    EXPECT_EQ(import->truth().targets.size(), 1u);
    EXPECT_EQ(import->starts().robotPose().mean, drive(robot).starts.robotPose().mean);
  }
  EXPECT_GT(targets, 200u);
}
}  // namespace
}  // namespace slamot::importers
