#include "FakeTeamFilter.h"

#include <gtest/gtest.h>
#include <slamot/fusion/candidates.h>
#include <slamot/math/random.h>

namespace slamot::fusion
{
namespace
{
// The place that a candidate stands for, from the definition.
Eigen::Vector2d place(const Eigen::Vector3d& pose, double range, double bearing)
{
  return {pose[0] + range * std::cos(pose[2] + bearing),
          pose[1] + range * std::sin(pose[2] + bearing)};
}
}  // namespace

TEST(Candidate, PlaceAndDerivativesAgreeWithDifferences)
{
  math::RandomStream random{1};
  for (int i = 0; i < 200; ++i)
  {
    core::RobotAndTarget sender = someEstimate(i % 2 ? 4 : 6);
    sender.mean.head(3) << random.uniform(-50, 50), random.uniform(-50, 50), random.uniform(-3, 3);
    const Candidate c{random.uniform(0.5, 60), random.uniform(-3, 3), 0.3, 0.05, core::kNoId};
    const Eigen::Vector3d pose = sender.mean.head(3);
    const int n = i % 2 ? 4 : sender.targetSize();
    const SeenPlace seen = placeOf(c, sender, n);
    EXPECT_TRUE(seen.mean.head(2).isApprox(place(pose, c.range, c.bearing), 1e-12));
    EXPECT_EQ(seen.mean.tail(n), sender.mean.segment(3, n));

    constexpr double h = 1e-6;
    Eigen::MatrixXd F = Eigen::MatrixXd::Zero(2 + n, 3 + n), Fz(2, 2);
    F.bottomRightCorner(n, n).setIdentity();
    for (int k = 0; k < 3; ++k)
    {
      const Eigen::Vector3d d = h * Eigen::Vector3d::Unit(k);
      F.block(0, k, 2, 1) =
          (place(pose + d, c.range, c.bearing) - place(pose - d, c.range, c.bearing)) / (2 * h);
    }
    Fz << (place(pose, c.range + h, c.bearing) - place(pose, c.range - h, c.bearing)) / (2 * h),
        (place(pose, c.range, c.bearing + h) - place(pose, c.range, c.bearing - h)) / (2 * h);
    EXPECT_TRUE(placeByPose(c, pose[2]).isApprox(F.topLeftCorner(2, 3), 1e-7));
    const Eigen::Matrix2d noise =
        Fz * Eigen::Vector2d(c.rangeStd * c.rangeStd, c.bearingStd * c.bearingStd).asDiagonal() *
        Fz.transpose();
    Eigen::MatrixXd expected = F * sender.cov.topLeftCorner(3 + n, 3 + n) * F.transpose();
    EXPECT_TRUE(seen.independent.topLeftCorner(2, 2).isApprox(noise, 1e-6));
    EXPECT_NEAR(seen.independent.norm(), noise.norm(), 1e-6 * noise.norm());
    expected.topLeftCorner(2, 2) += noise;
    EXPECT_TRUE(seen.cov.isApprox(expected, 1e-6));
    EXPECT_GT(math::smallestEigenvalue(seen.cov), 0);
  }
}

TEST(Candidate, WithoutTargetIsAPlaceAlone)
{
  const SeenPlace seen = placeOf({2, 0, 0.1, 0.01, core::kNoId}, someEstimate(6), 0);
  EXPECT_EQ(seen.mean.size(), 2);
  EXPECT_EQ(seen.cov.rows(), 2);
}
}  // namespace slamot::fusion
