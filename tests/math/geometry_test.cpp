#include <gtest/gtest.h>
#include <slamot/math/geometry.h>
#include <slamot/math/random.h>

#include <Eigen/Geometry>
#include <limits>

namespace slamot::math
{
namespace
{
Pose2D drawPose(RandomStream& random)
{
  return {random.uniform(-20, 20), random.uniform(-20, 20), random.uniform(-kPi, kPi)};
}

// The same pose as a 3x3 matrix: another way to compute all of this.
Eigen::Isometry2d matrix(const Pose2D& p)
{
  return Eigen::Translation2d(p.x, p.y) * Eigen::Rotation2Dd(p.phi);
}

void expectSame(const Pose2D& a, const Pose2D& b)
{
  EXPECT_NEAR(a.x, b.x, 1e-12);
  EXPECT_NEAR(a.y, b.y, 1e-12);
  EXPECT_NEAR(wrapToPi(a.phi - b.phi), 0, 1e-12);
}
}  // namespace

TEST(WrapToPi, LeavesAnglesOfTheRangeBitForBit)
{
  for (const double a : {0.0, -0.0, 1.0, -3.0, kPi, std::nextafter(-kPi, 0.0), 1e-300})
    EXPECT_EQ(wrapToPi(a), a);
}

TEST(WrapToPi, TurnsMinusPiToPi)
{
  EXPECT_EQ(wrapToPi(-kPi), kPi);
  EXPECT_EQ(wrapToPi(3 * kPi), kPi);
  EXPECT_EQ(wrapToPi(-3 * kPi), kPi);
}

TEST(WrapToPi, GivesTheSameAngle)
{
  RandomStream random{1};
  for (int i = 0; i < 1000; ++i)
  {
    const double a = random.uniform(-1000, 1000), w = wrapToPi(a);
    EXPECT_NEAR(std::cos(w), std::cos(a), 1e-12);
    EXPECT_NEAR(std::sin(w), std::sin(a), 1e-12);
  }
}

TEST(WrapToPi, StaysInTheHalfOpenRangeAroundOddMultiplesOfPi)
{
  for (int k = -2001; k <= 2001; k += 2)
  {
    double a = k * kPi;
    for (int i = 0; i < 6; ++i) a = std::nextafter(a, -1e9);
    for (int i = -6; i <= 6; ++i, a = std::nextafter(a, 1e9))
    {
      const double w = wrapToPi(a);
      ASSERT_GT(w, -kPi) << a;
      ASSERT_LE(w, kPi) << a;
    }
  }
}

TEST(WrapToPi, KeepsNaN)
{
  EXPECT_TRUE(std::isnan(wrapToPi(std::numeric_limits<double>::quiet_NaN())));
  EXPECT_TRUE(std::isnan(wrapToPi(std::numeric_limits<double>::infinity())));
}

TEST(Compose, EqualsTheProductOfMatrices)
{
  RandomStream random{2};
  for (int i = 0; i < 200; ++i)
  {
    const Pose2D a = drawPose(random), b = drawPose(random), c = compose(a, b);
    EXPECT_TRUE(matrix(c).isApprox(matrix(a) * matrix(b), 1e-12));
    EXPECT_TRUE(c.phi > -kPi && c.phi <= kPi);
  }
}

TEST(Between, UndoesCompose)
{
  RandomStream random{3};
  for (int i = 0; i < 200; ++i)
  {
    const Pose2D a = drawPose(random), b = drawPose(random);
    expectSame(compose(a, between(a, b)), b);
    expectSame(between(a, compose(a, b)), b);
    expectSame(between(a, a), {});
  }
}

TEST(Transform, IsComposeOfAPointAndItsInverseIsInBetween)
{
  RandomStream random{4};
  for (int i = 0; i < 200; ++i)
  {
    const Pose2D a = drawPose(random);
    const Point2D p{random.uniform(-5, 5), random.uniform(-5, 5)}, q = transform(a, p);
    const Vector2 expected = matrix(a) * Vector2(p.x, p.y);
    EXPECT_NEAR(q.x, expected[0], 1e-12);
    EXPECT_NEAR(q.y, expected[1], 1e-12);
    const Pose2D back = between(a, {q.x, q.y, 0});
    EXPECT_NEAR(back.x, p.x, 1e-12);
    EXPECT_NEAR(back.y, p.y, 1e-12);
  }
}

TEST(PoseRotation, TurnsThePlaneAndLeavesTheHeading)
{
  const Matrix3 r = poseRotation(0.7);
  const Vector3 v = r * Vector3(2, 0, 5);
  EXPECT_NEAR(v[0], 2 * std::cos(0.7), 1e-15);
  EXPECT_NEAR(v[1], 2 * std::sin(0.7), 1e-15);
  EXPECT_EQ(v[2], 5);
  EXPECT_TRUE((r * r.transpose()).isIdentity(1e-15));
}

TEST(Degrees, AreRadiansAndBack)
{
  EXPECT_DOUBLE_EQ(degToRad(180), kPi);
  EXPECT_DOUBLE_EQ(radToDeg(degToRad(-37.5)), -37.5);
}
}  // namespace slamot::math
