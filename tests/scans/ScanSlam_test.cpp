#include <gtest/gtest.h>
#include <slamot/scans/ScanSlam.h>

#include "drawnHouse.h"

namespace slamot::scans
{
namespace
{
using namespace slamot::test;

Settings defaults(const std::string& keys = "")
{
  core::Config config = core::Config::parse("[scan-slam]\n" + keys, "test");
  core::Params params(config, "scan-slam");
  const Settings out = Settings::from(params);
  config.requireAllRead();
  return out;
}

/// Known exactly.  (Braces alone would leave the covariance as the memory was.)
Gaussian<Pose2D> at(const Pose2D& pose)
{
  Gaussian<Pose2D> out;
  out.mean = pose;
  return out;
}

std::vector<Pose2D> ringDrive()
{
  return driveAlong({{4, 1}, {23, 1}, {23, 15}, {1, 15}, {1, 1}, {12, 1}});
}

double worstError(const std::vector<core::PathPose>& path, const std::vector<Pose2D>& drive)
{
  double worst = 0;
  for (std::size_t i = 0; i < path.size(); ++i)
  {
    const Pose2D d = math::between(drive[i + 1], path[i].pose);
    worst = std::max(worst, std::hypot(d.x, d.y));
  }
  return worst;
}

void drive(ScanSlam& slam, const std::vector<core::Step>& steps)
{
  for (const core::Step& step : steps)
  {
    if (step.odometry) slam.move(*step.odometry);
    const auto returns = returnsOf(step.lasers, 25);
    slam.match(returns);
    slam.insert(returns);
    if (step.odometry) slam.note(step.time);
  }
}

TEST(ScanSlam, ClosesTheLoopOfARingCorridor)
{
  const auto truth = ringDrive();
  const auto steps = stepsOf(ringCorridor(), truth, 1, 0.02);
  Pose2D odometry = truth.front();
  for (const core::Step& s : steps)
    if (s.odometry) odometry = math::compose(odometry, s.odometry->mean);
  EXPECT_GT(math::between(truth.back(), odometry).norm(), 3);  // or there is nothing to show
  ScanSlam slam(defaults(), at(truth.front()));
  drive(slam, steps);
  EXPECT_GT(slam.counts().loops, 0);
  const auto path = slam.path();
  ASSERT_EQ(path.size(), truth.size() - 1);
  EXPECT_LT(worstError(path, truth), 0.25);
  const Vector3 e = {slam.pose().mean.x - truth.back().x, slam.pose().mean.y - truth.back().y,
                     math::wrapToPi(slam.pose().mean.phi - truth.back().phi)};
  EXPECT_LT(e.head<2>().norm(), 0.1);
  EXPECT_LT(math::mahalanobisSquared(e, slam.pose().cov), 25);
}

TEST(ScanSlam, LoopsMakeThePathBetter)
{
  const auto truth = ringDrive();
  double with = 0, without = 0;
  for (std::uint64_t seed = 2; seed < 5; ++seed)
  {
    const auto steps = stepsOf(ringCorridor(), truth, seed);
    ScanSlam open(defaults("loops = false\n"), at(truth.front()));
    ScanSlam closed(defaults(), at(truth.front()));
    drive(open, steps);
    drive(closed, steps);
    EXPECT_EQ(open.counts().loops, 0);
    without += worstError(open.path(), truth);
    with += worstError(closed.path(), truth);
  }
  EXPECT_LT(with, without);
}

/// A corridor whose bays all look alike, driven there and back: no loop may take one for another.
TEST(ScanSlam, IsNotFooledByBaysThatLookAlike)
{
  Walls walls;
  addBox(walls, 0, 0, 30, 2.2);
  for (int i = 0; i < 9; ++i) addBox(walls, 2.5 + 3 * i, 0, 3.5 + 3 * i, 0.4);
  const auto truth = driveAlong({{2, 1.3}, {28, 1.3}, {2, 1.3}, {28, 1.3}});
  for (std::uint64_t seed = 1; seed < 4; ++seed)
  {
    ScanSlam slam(defaults(), at(truth.front()));
    drive(slam, stepsOf(walls, truth, seed));
    EXPECT_GT(slam.counts().loops, 0);
    EXPECT_LT(worstError(slam.path(), truth), 0.5) << "seed " << seed;
  }
}

TEST(ScanSlam, KeepsNothingOfBeamsLeftOut)
{
  math::RandomStream random{3};
  Walls walls = room();
  const Pose2D pose{3, 2, 0};
  const auto seen = returnsOf({scanFrom(walls, pose, random)}, 25);
  ScanSlam slam(defaults(), at(pose));
  slam.insert(seen, std::vector<bool>(181, true));
  EXPECT_EQ(slam.counts().keyframes, 0);
  EXPECT_FALSE(slam.match(seen).matched);  // nothing was kept to match with
  std::vector<bool> half(181, false);
  std::fill(half.begin(), half.begin() + 120, true);
  slam.insert(seen, half);
  const Match m = slam.match(seen);
  EXPECT_LT(m.explained, 0.6);
  ScanSlam whole(defaults(), at(pose));
  whole.insert(seen);
  EXPECT_GT(whole.match(seen).explained, 0.8);
}

TEST(ScanSlam, CarriesTheStartsUncertaintyThroughLoops)
{
  const auto truth = ringDrive();
  const auto steps = stepsOf(ringCorridor(), truth, 6);
  Gaussian<Pose2D> start = at(truth.front());
  start.cov = Vector3(0.25, 0.25, 0.01).asDiagonal();
  ScanSlam exact(defaults(), at(truth.front())), vague(defaults(), start);
  drive(exact, steps);
  drive(vague, steps);
  EXPECT_GT(vague.counts().loops, 0);
  // What the start adds: its own covariance, carried to where the robot is.
  Gaussian<Pose2D> rigid;
  rigid.mean = math::between(truth.front(), exact.pose().mean);
  const Matrix3 expected = exact.pose().cov + math::compose(start, rigid).cov;
  EXPECT_LT((vague.pose().cov - expected).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(ScanSlam, GoesByOdometryWhereNothingIsSeen)
{
  ScanSlam slam(defaults(), {});
  Gaussian<Pose2D> sum, step;
  step.mean = {0.3, 0, 0.1};
  step.cov = Vector3(1e-4, 1e-4, 1e-4).asDiagonal();
  for (int i = 0; i < 20; ++i)
  {
    slam.move(step);
    slam.match({});
    slam.insert({});
    sum = math::compose(sum, step);
  }
  EXPECT_LT(math::between(sum.mean, slam.pose().mean).norm(), 1e-9);
  EXPECT_LT((sum.cov - slam.pose().cov).cwiseAbs().maxCoeff(), 1e-9);
}
}  // namespace
}  // namespace slamot::scans
