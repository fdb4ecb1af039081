#include <gtest/gtest.h>
#include <slamot/models/RangeBearing.h>

namespace slamot::models
{
// The laws of observation models are proved in tests/laws; these are numbers that a person can
// check.
TEST(RangeBearing, PredictsAThreeFourFiveTriangle)
{
  const Vector2 z = RangeBearing::predict({1, 2, math::kPi / 2}, {4, 6});
  EXPECT_DOUBLE_EQ(z[0], 5);
  EXPECT_DOUBLE_EQ(z[1], std::atan2(4, 3) - math::kPi / 2);
}

TEST(RangeBearing, JacobiansOfAPointStraightAhead)
{
  const auto J = RangeBearing::jacobians({0, 0, 0}, {2, 0});
  Eigen::Matrix<double, 2, 3> pose;
  pose << -1, 0, 0, 0, -0.5, -1;
  Matrix2 point;
  point << 1, 0, 0, 0.5;
  EXPECT_TRUE(J.pose.isApprox(pose, 1e-15));
  EXPECT_TRUE(J.point.isApprox(point, 1e-15));
}

TEST(RangeBearing, ResidualWrapsAcrossPi)
{
  const Vector2 nu = RangeBearing::residual({2, math::kPi - 0.01}, {1.5, -math::kPi + 0.01});
  EXPECT_DOUBLE_EQ(nu[0], 0.5);
  EXPECT_NEAR(nu[1], -0.02, 1e-15);
}

TEST(RangeBearing, HasNoDerivativeBelowOneCentimetre)
{
  EXPECT_THROW((void)RangeBearing::jacobians({1, 1, 0}, {1, 1}), std::domain_error);
  EXPECT_THROW((void)RangeBearing::jacobians({0, 0, 0}, {0.00999, 0}), std::domain_error);
  EXPECT_NO_THROW((void)RangeBearing::jacobians({0, 0, 0}, {0.0101, 0}));
}

TEST(RangeBearing, NoiseIsIndependent)
{
  EXPECT_EQ(RangeBearing(0.5, 0.25).noise(), Matrix2(Vector2(0.25, 0.0625).asDiagonal()));
}
}  // namespace slamot::models
