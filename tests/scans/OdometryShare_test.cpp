#include <gtest/gtest.h>
#include <slamot/math/geometry.h>
#include <slamot/scans/OdometryShare.h>
#include <slamot/scans/ScanSlam.h>

#include "keyframes.h"

namespace slamot::scans
{
namespace
{
const Gaussian<Pose2D> kStep{{0.2, 0.02, 0.1}, 1e-4 * Matrix3::Identity()};
}  // namespace

TEST(OdometryShare, AllOfItIsNewWhereNoScanCameBetween)
{
  OdometryShare share;
  EXPECT_EQ(share.next(kStep, 1.0).mean, kStep.mean);
  EXPECT_EQ(share.next(kStep, 1.2).mean, kStep.mean);
  share.matched(1.2);  // of the same step
  EXPECT_EQ(share.next(kStep, 1.4).mean, kStep.mean);
}

TEST(OdometryShare, OnlyWhatCameAfterTheMatchedScanIsNew)
{
  OdometryShare share;
  (void)share.next(kStep, 1.0);
  share.matched(1.15);
  const Gaussian<Pose2D> rest = share.next(kStep, 1.2);
  EXPECT_NEAR(rest.mean.x, 0.05, 1e-12);
  EXPECT_NEAR(rest.mean.phi, 0.025, 1e-12);
  EXPECT_NEAR(rest.cov(0, 0), 0.25e-4, 1e-12);
  EXPECT_EQ(share.next(kStep, 1.4).mean, kStep.mean);
}

TEST(BlindMotion, ManyStepsAreAsUncertainAsOne)
{
  core::Config config = core::Config::parse("[scan-slam]\n", "test");
  core::Params params(config, "scan-slam");
  const Settings settings = Settings::from(params);
  const Matrix3 one = blindMotion(0, 2.0, settings).cov;
  Matrix3 many = Matrix3::Zero();
  for (int i = 0; i < 20; ++i) many += blindMotion(0.1 * i, 0.1, settings).cov;
  EXPECT_NEAR(one(0, 0), std::pow(2.0 * settings.blindSpeed, 2), 1e-9);
  EXPECT_LT((one - many).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(Keyframes, ARobotThatTurnsOnTheSpotHasBoundedSurroundings)
{
  const Keyframes turning(1000);  // no path
  const auto [first, last] = around(turning, 500, 12);
  EXPECT_EQ(first, 440u);
  EXPECT_EQ(last, 560u);
}
}  // namespace slamot::scans
