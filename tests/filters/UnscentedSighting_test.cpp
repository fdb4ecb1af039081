#include "sighting/unscentedSighting.h"

#include <gtest/gtest.h>
#include <slamot/math/random.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace slamot::filters
{
namespace
{
using math::RandomStream;

struct Case
{
  Pose2D pose;
  Matrix3 poseCov;
  maps::Landmark m;
  Ray ray;
};

Case draw(RandomStream& random, double std, bool sampledPose)
{
  Case c{};
  c.pose = {random.uniform(-5, 5), random.uniform(-5, 5), random.uniform(-3, 3)};
  const double r = random.uniform(5, 30), b = random.uniform(-3.1, 3.1);
  const Point2D at = math::transform(c.pose, {r * std::cos(b), r * std::sin(b)});
  const double k = random.uniform(-0.8, 0.8);
  c.m = {at.x, at.y, std * std, 0.5 * k * std * std, 0.25 * std * std, 1, 0};
  c.ray = Ray::of(r + random.uniform(-1, 1), b + random.uniform(-0.1, 0.1), 0.1, 0.02);
  const Vector3 scale(std, 0.5 * std, 0.02);
  Matrix3 A;
  for (int i = 0; i < 3; ++i) A.row(i) = scale[i] * random.normal3().transpose();
  c.poseCov = sampledPose ? Matrix3::Zero() : Matrix3(A * A.transpose());
  return c;
}

/// Mean, covariance and cross-covariance with (point, pose) of what is expected, by the unscented
/// transform over point and pose together (five coordinates), written in matrices.
struct Moments
{
  Vector2 mean = Vector2::Zero();
  Matrix2 cov = Matrix2::Zero();
  Eigen::Matrix<double, 5, 2> cross = Eigen::Matrix<double, 5, 2>::Zero();
};
template <class Columns>
Moments unscented(const Case& c, const Columns& L, double spread2)
{
  const auto n = L.cols();
  const Vector2 zero = [&]
  {
    const double dx = c.m.x - c.pose.x, dy = c.m.y - c.pose.y;
    return Vector2(std::hypot(dx, dy), std::atan2(dy, dx) - c.pose.phi);
  }();
  const auto expected = [&](const Eigen::Matrix<double, 5, 1>& d)
  {
    const double dx = c.m.x + d[0] - c.pose.x - d[2], dy = c.m.y + d[1] - c.pose.y - d[3];
    return Vector2(std::hypot(dx, dy) - zero[0],
                   math::wrapToPi(std::atan2(dy, dx) - c.pose.phi - d[4] - zero[1]));
  };
  const double w = 0.5 / spread2, w0 = 1 - static_cast<double>(2 * n) * w;
  Moments out;
  for (Eigen::Index k = 0; k < n; ++k)
    for (const double sign : {-1.0, 1.0})
      out.mean += w * expected(sign * std::sqrt(spread2) * L.col(k));
  out.cov = w0 * out.mean * out.mean.transpose();
  for (Eigen::Index k = 0; k < n; ++k)
    for (const double sign : {-1.0, 1.0})
    {
      const Eigen::Matrix<double, 5, 1> d = sign * std::sqrt(spread2) * L.col(k);
      const Vector2 e = expected(d) - out.mean;
      out.cov += w * e * e.transpose();
      out.cross += w * d * e.transpose();
    }
  out.mean += zero;
  return out;
}

Matrix2 covOf(const Innovation& o)
{
  Matrix2 S;
  S << o.s11, o.s12, o.s12, o.s22;
  return S;
}
Matrix2 slopeOf(const Innovation& o)
{
  Matrix2 H;
  H << o.h11, o.h12, o.h21, o.h22;
  return H;
}
}  // namespace

// With a sampled pose the transform is over the point alone: the very same five sigma points.
TEST(UnscentedSighting, OfASampledPoseIsTheTransformOverThePoint)
{
  RandomStream random{1};
  for (int n = 0; n < 500; ++n)
  {
    const Case c = draw(random, random.uniform(0.05, 0.8), true);
    Eigen::Matrix<double, 5, 2> L = Eigen::Matrix<double, 5, 2>::Zero();
    const double a = std::atan2(c.m.y - c.pose.y, c.m.x - c.pose.x);  // of the line of sight
    const Matrix2 R = math::poseRotation(a).topLeftCorner<2, 2>();
    L.topRows<2>() = R * Matrix2((R.transpose() * c.m.cov() * R).llt().matrixL());
    const Moments u = unscented(c, L, 3);
    Innovation o;
    ASSERT_TRUE(
        innovateUnscented(Eye(c.pose), c.ray, c.m.x, c.m.y, c.m.cxx, c.m.cxy, c.m.cyy, nullptr, o));
    Matrix2 S = u.cov;
    S(0, 0) += c.ray.varRange;
    S(1, 1) += c.ray.varBearing;
    EXPECT_LT((covOf(o) - S).norm(), 1e-10);
    EXPECT_LT((c.m.cov() * slopeOf(o).transpose() - u.cross.topRows<2>()).norm(), 1e-10);
    EXPECT_NEAR(o.nuR, c.ray.range - u.mean[0], 1e-10);
    EXPECT_NEAR(math::wrapToPi(o.nuB - (c.ray.bearing - u.mean[1])), 0, 1e-10);
    const Vector2 nu(o.nuR, o.nuB);
    EXPECT_NEAR(o.d2, nu.dot(S.inverse() * nu), 1e-8 * (1 + o.d2));
  }
}

// With a pose in doubt, the augmented state has five coordinates (or seven, with the sighting's
// noise).  The transform over the two of the difference has the same moments to second order: where
// the doubt halves, what differs falls to a sixteenth.
TEST(UnscentedSighting, EqualsTheAugmentedTransformToItsOrder)
{
  const auto difference = [](double scale)
  {
    RandomStream random{2};
    double sum = 0;
    for (int n = 0; n < 200; ++n)
    {
      Case c = draw(random, 0.8, false);
      c.m.cxx *= scale * scale;
      c.m.cxy *= scale * scale;
      c.m.cyy *= scale * scale;
      c.poseCov *= scale * scale;
      Eigen::Matrix<double, 5, 5> P = Eigen::Matrix<double, 5, 5>::Zero();
      P.topLeftCorner<2, 2>() = c.m.cov();
      P.bottomRightCorner<3, 3>() = c.poseCov;
      const Eigen::Matrix<double, 5, 5> L = P.llt().matrixL();
      const Moments u = unscented(c, L, 3);
      Innovation o;
      EXPECT_TRUE(innovateUnscented(Eye(c.pose), c.ray, c.m.x, c.m.y, c.m.cxx, c.m.cxy, c.m.cyy,
                                    &c.poseCov, o));
      Matrix2 S = u.cov;
      S(0, 0) += c.ray.varRange;
      S(1, 1) += c.ray.varBearing;
      sum += (covOf(withPose(o, c.poseCov)) - S).norm() + std::abs(o.nuR - c.ray.range + u.mean[0]);
    }
    return sum;
  };
  const double whole = difference(1), half = difference(0.5);
  EXPECT_GT(whole, 1e-6);  // they are not the same sigma points
  EXPECT_LT(half, whole / 10);
}

TEST(UnscentedSighting, TendsToTheLinearOneWithoutDoubt)
{
  RandomStream random{3};
  for (int n = 0; n < 200; ++n)
  {
    Case c = draw(random, 1e-4, false);
    c.poseCov *= 1e-4;
    Innovation u, o;
    ASSERT_TRUE(innovateUnscented(Eye(c.pose), c.ray, c.m.x, c.m.y, c.m.cxx, c.m.cxy, c.m.cyy,
                                  &c.poseCov, u));
    ASSERT_TRUE(innovate(Eye(c.pose), c.ray, c.m.x, c.m.y, c.m.cxx, c.m.cxy, c.m.cyy, o));
    EXPECT_NEAR(u.nuR, o.nuR, 1e-7);
    EXPECT_NEAR(u.nuB, o.nuB, 1e-7);
    EXPECT_LT((covOf(u) - covOf(o)).norm(), 1e-9);
    EXPECT_LT((slopeOf(u) - slopeOf(o)).norm(), 1e-6);
  }
}

// A range to a point in doubt across the ray is longer on the mean than to its mean.
TEST(UnscentedSighting, TakesTheMeanWhereTheLinearOneIsBiased)
{
  const maps::Landmark m{10, 0, 0.01, 0, 1, 1, 0};
  Innovation u, o;
  const Eye eye(Pose2D{});
  const Ray ray = Ray::of(10.05, 0, 0.1, 0.02);
  ASSERT_TRUE(innovateUnscented(eye, ray, m.x, m.y, m.cxx, m.cxy, m.cyy, nullptr, u));
  ASSERT_TRUE(innovate(eye, ray, m.x, m.y, m.cxx, m.cxy, m.cyy, o));
  EXPECT_NEAR(o.nuR, 0.05, 1e-12);
  EXPECT_NEAR(u.nuR, 0.0, 1e-3);  // E[r] = 10 + 1/(2 10)
}

TEST(UnscentedSighting, ACertainPointAndTheRobotsOwnPlaceFallBackToTheLinearOne)
{
  const Eye eye(Pose2D{});
  Innovation u, o;
  const Ray ray = Ray::of(10, 0.1, 0.1, 0.02);
  ASSERT_TRUE(innovateUnscented(eye, ray, 10, 1, 0, 0, 0, nullptr, u));
  ASSERT_TRUE(innovate(eye, ray, 10, 1, 0, 0, 0, o));
  EXPECT_EQ(u.d2, o.d2);
  ASSERT_TRUE(innovateUnscented(eye, Ray::of(1, 0, 0.1, 0.02), 0.5, 0.5, 1, 0, 1, nullptr, u));
  ASSERT_TRUE(innovate(eye, Ray::of(1, 0, 0.1, 0.02), 0.5, 0.5, 1, 0, 1, o));
  EXPECT_EQ(u.d2, o.d2);
}

TEST(UnscentedSighting, TheInverseIsTheTransformOverRangeAndBearing)
{
  RandomStream random{5};
  for (int n = 0; n < 100; ++n)
  {
    const Pose2D pose(random.uniform(-5, 5), random.uniform(-5, 5), random.uniform(-3, 3));
    const Ray ray = Ray::of(random.uniform(1, 30), random.uniform(-3, 3), 0.3, 0.15);
    const auto place = [&](double dr, double db)
    {
      const double a = pose.phi + ray.bearing + db;
      return Vector2(pose.x + (ray.range + dr) * std::cos(a),
                     pose.y + (ray.range + dr) * std::sin(a));
    };
    const double sr = std::sqrt(3 * ray.varRange), sb = std::sqrt(3 * ray.varBearing);
    const Vector2 points[] = {place(0, 0), place(sr, 0), place(-sr, 0), place(0, sb),
                              place(0, -sb)};
    const double weights[] = {1.0 / 3, 1.0 / 6, 1.0 / 6, 1.0 / 6, 1.0 / 6};
    Vector2 mean = Vector2::Zero();
    for (int k = 0; k < 5; ++k) mean += weights[k] * points[k];
    Matrix2 cov = Matrix2::Zero();
    for (int k = 0; k < 5; ++k)
      cov += weights[k] * (points[k] - mean) * (points[k] - mean).transpose();
    const Gaussian<Point2D> out = invertUnscented(Eye(pose), ray);
    EXPECT_NEAR(out.mean.x, mean[0], 1e-10);
    EXPECT_NEAR(out.mean.y, mean[1], 1e-10);
    EXPECT_LT((out.cov - cov).norm(), 1e-10);
  }
}
}  // namespace slamot::filters
