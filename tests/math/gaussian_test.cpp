#include <gtest/gtest.h>
#include <slamot/math/gaussian.h>
#include <slamot/math/random.h>
#include <slamot/math/statistics.h>

#include <Eigen/LU>
#include <limits>

namespace slamot::math
{
namespace
{
Matrix3 drawCovariance(RandomStream& random, int rank = 3)
{
  Eigen::MatrixXd A(3, rank);
  for (double& a : A.reshaped()) a = random.normal();
  return A * A.transpose();
}

Gaussian<Pose2D> drawGaussian(RandomStream& random)
{
  return {{random.uniform(-5, 5), random.uniform(-5, 5), random.uniform(-3, 3)},
          drawCovariance(random)};
}

// Derivative of compose(a, b) by a (which = 0) or b, by central differences.
Matrix3 slope(const Pose2D& a, const Pose2D& b, int which)
{
  constexpr double h = 1e-6;
  Matrix3 J;
  for (int i = 0; i < 3; ++i)
  {
    Pose2D lo[2] = {a, b}, hi[2] = {a, b};
    lo[which][i] -= h;
    hi[which][i] += h;
    const Pose2D l = compose(lo[0], lo[1]), u = compose(hi[0], hi[1]);
    J.col(i) << (u.x - l.x) / (2 * h), (u.y - l.y) / (2 * h), wrapToPi(u.phi - l.phi) / (2 * h);
  }
  return J;
}
}  // namespace

TEST(GaussianCompose, CarriesCovariancesByTheDerivatives)
{
  RandomStream random{1};
  for (int i = 0; i < 100; ++i)
  {
    const auto a = drawGaussian(random), b = drawGaussian(random), c = compose(a, b);
    const Matrix3 A = slope(a.mean, b.mean, 0), B = slope(a.mean, b.mean, 1);
    const Matrix3 expected = A * a.cov * A.transpose() + B * b.cov * B.transpose();
    EXPECT_TRUE(c.cov.isApprox(expected, 1e-7)) << c.cov << "\n\n" << expected;
    EXPECT_EQ(c.mean, compose(a.mean, b.mean));
    EXPECT_EQ(asymmetry(c.cov), 0);
  }
}

TEST(GaussianCompose, IsAssociative)
{
  RandomStream random{2};
  for (int i = 0; i < 100; ++i)
  {
    const auto a = drawGaussian(random), b = drawGaussian(random), c = drawGaussian(random);
    const auto left = compose(compose(a, b), c), right = compose(a, compose(b, c));
    EXPECT_TRUE(left.cov.isApprox(right.cov, 1e-12));
  }
}

TEST(TurnThenMove, TurnsFirst)
{
  const auto g = turnThenMove(2.0, kPi / 2, 1.0, 0, 0);
  EXPECT_NEAR(g.mean.x, 0, 1e-15);
  EXPECT_NEAR(g.mean.y, 2, 1e-15);
  EXPECT_NEAR(g.mean.phi, kPi / 2, 1e-15);
  EXPECT_TRUE(g.cov.isZero());
}

TEST(TurnThenMove, CovarianceFollowsTheDerivativesOfTheMean)
{
  constexpr double v = 1.3, w = -0.8, dt = 0.4, stdV = 0.2, stdW = 0.3, h = 1e-6;
  Eigen::Matrix<double, 3, 2> G;
  for (int i = 0; i < 2; ++i)
  {
    const double dv = i == 0 ? h : 0, dw = h - dv;
    const Pose2D a = turnThenMove(v - dv, w - dw, dt, 0, 0).mean,
                 b = turnThenMove(v + dv, w + dw, dt, 0, 0).mean;
    G.col(i) << (b.x - a.x) / (2 * h), (b.y - a.y) / (2 * h), (b.phi - a.phi) / (2 * h);
  }
  const Matrix3 expected = G * Vector2(stdV * stdV, stdW * stdW).asDiagonal() * G.transpose();
  EXPECT_TRUE(turnThenMove(v, w, dt, stdV, stdW).cov.isApprox(expected, 1e-8));
}

TEST(TurnThenMove, CovarianceIsThatOfSampledMotions)
{
  constexpr double v = 1.0, w = 0.5, dt = 0.1, stdV = 0.1, stdW = 0.1;
  constexpr int kSamples = 20000;
  const auto g = turnThenMove(v, w, dt, stdV, stdW);
  RandomStream random{3};
  double sum[2] = {};
  for (int i = 0; i < kSamples; ++i)
  {
    const Pose2D p =
        turnThenMove(v + stdV * random.normal(), w + stdW * random.normal(), dt, 0, 0).mean;
    const Vector2 e(p.x - g.mean.x, p.phi - g.mean.phi);
    // Two noises make a rank of two: x and heading hold it all.
    Matrix2 P;
    P << g.cov(0, 0), g.cov(0, 2), g.cov(2, 0), g.cov(2, 2);
    sum[0] += mahalanobisSquared(e, P);
    sum[1] += e[1] * e[1] / g.cov(2, 2);
  }
  EXPECT_LT(sum[0], chiSquareQuantile(0.9998, 2 * kSamples));
  EXPECT_GT(sum[0], chiSquareQuantile(0.0002, 2 * kSamples));
  EXPECT_LT(sum[1], chiSquareQuantile(0.9998, kSamples));
  EXPECT_GT(sum[1], chiSquareQuantile(0.0002, kSamples));
}

TEST(SquareRoot, SquaresToTheMatrixAtEveryRank)
{
  RandomStream random{4};
  for (int rank = 0; rank <= 3; ++rank)
    for (int i = 0; i < 50; ++i)
    {
      const double scale = std::pow(10.0, random.uniform(-12, 6));
      const Matrix3 cov = scale * (rank == 0 ? Matrix3::Zero() : drawCovariance(random, rank));
      const Matrix3 L = squareRoot(cov);
      EXPECT_LE((L * L.transpose() - cov).norm(), 1e-13 * cov.norm()) << cov;
    }
}

// Noise drawn by it must not jump where rounding turns the axes of a circle.
TEST(SquareRoot, IsSymmetricAndTurnsWithTheMatrix)
{
  const Matrix3 cov = Vector3(0.04, 0.04, 0.01).asDiagonal(), L = squareRoot(cov);
  EXPECT_TRUE(L.isApprox(Matrix3(Vector3(0.2, 0.2, 0.1).asDiagonal()), 1e-14));
  for (const double angle : {1e-17, 0.3, 2.0, -3.0})
  {
    const Matrix3 R = poseRotation(angle), turned = R * cov * R.transpose();
    EXPECT_TRUE((R * L * R.transpose()).isApprox(squareRoot(turned), 1e-14));
    EXPECT_LE(asymmetry(squareRoot(turned)), 1e-16);
  }
}

TEST(SquareRoot, TakesRoundingBelowZeroForZero)
{
  const Matrix3 cov = Vector3(1, 1, -1e-9).asDiagonal();
  const Matrix3 L = squareRoot(cov);
  EXPECT_TRUE((L * L.transpose()).isApprox(Matrix3(Vector3(1, 1, 0).asDiagonal()), 1e-14));
}

TEST(SquareRoot, RefusesWhatIsNoCovariance)
{
  EXPECT_THROW((void)squareRoot(Vector3(1, 1, -1e-6).asDiagonal()), std::domain_error);
  EXPECT_THROW((void)squareRoot(Vector3(0, 0, -1e-6).asDiagonal()), std::domain_error);
  Matrix3 nan = Matrix3::Identity();
  nan(1, 2) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)squareRoot(nan), std::domain_error);
}

TEST(Ellipse, HasTheCovarianceOfItsAxes)
{
  RandomStream random{6};
  for (int i = 0; i < 100; ++i)
  {
    Matrix2 root;
    root << random.normal(), random.normal(), random.normal(), i % 5 ? random.normal() : 0;
    if (i % 4 == 0) root.col(1).setZero();  // a line
    const Matrix2 cov = root * root.transpose();
    const Ellipse e = ellipse(cov);
    const Vector2 u(std::cos(e.direction), std::sin(e.direction)), v(-u[1], u[0]);
    const Matrix2 drawn = e.longer * e.longer * u * u.transpose() +
                          e.shorter * e.shorter * v * v.transpose();
    EXPECT_LE((drawn - cov).norm(), 1e-14 * cov.norm()) << cov;
    EXPECT_GE(e.longer, e.shorter);
  }
}

TEST(Ellipse, IsACircleOrAPointWhereTheCovarianceIs)
{
  const Ellipse circle = ellipse(4 * Matrix2::Identity());
  EXPECT_EQ(circle.longer, 2);
  EXPECT_EQ(circle.shorter, 2);
  EXPECT_EQ(ellipse(Matrix2::Zero()).longer, 0);
}

TEST(Asymmetry, IsTheLargestDifference)
{
  Matrix3 m = Matrix3::Identity();
  EXPECT_EQ(asymmetry(m), 0);
  m(0, 2) = 0.25;
  m(1, 0) = -0.125;
  EXPECT_EQ(asymmetry(m), 0.25);
}

TEST(SmallestEigenvalue, IsFoundAndNaNStaysNaN)
{
  const Matrix3 R = poseRotation(0.3);
  EXPECT_NEAR(smallestEigenvalue(R * Vector3(3, -2, 5).asDiagonal() * R.transpose()), -2, 1e-14);
  Matrix2 nan = Matrix2::Identity();
  nan(0, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(smallestEigenvalue(nan)));
}

TEST(Mahalanobis, EqualsTheInverseAndRefusesSingularCovariances)
{
  RandomStream random{5};
  const Matrix3 P = drawCovariance(random);
  const Vector3 e(1, -2, 3);
  EXPECT_NEAR(mahalanobisSquared(e, P), e.dot(P.inverse() * e), 1e-9);
  EXPECT_THROW((void)mahalanobisSquared(e, Matrix3::Zero()), std::domain_error);
  EXPECT_THROW((void)mahalanobisSquared(e, -P), std::domain_error);
}
}  // namespace slamot::math
