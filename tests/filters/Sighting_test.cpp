#include "rbpf/Sighting.h"

#include <gtest/gtest.h>
#include <slamot/math/gaussian.h>
#include <slamot/math/random.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

// The inner loop is written out by hand; RangeBearing and Eigen are the readable form.
namespace slamot::filters::rbpf
{
namespace
{
using math::RandomStream;
using models::RangeBearing;

struct Scene
{
  Pose2D pose;
  maps::Landmark landmark;
  Vector2 z;
  double rangeStd, bearingStd;

  [[nodiscard]] Ray ray() const { return Ray::of(z[0], z[1], rangeStd, bearingStd); }
  [[nodiscard]] Matrix2 R() const { return RangeBearing(rangeStd, bearingStd).noise(); }
};

/// A landmark anywhere, and a sighting that is near its own point or anywhere too.
Scene drawScene(RandomStream& random, double range = 0)
{
  Scene s;
  s.pose = {random.uniform(-5, 5), random.uniform(-5, 5), random.uniform(-math::kPi, math::kPi)};
  const double r = range > 0 ? range : random.uniform(0.1, 20), b = random.uniform(-3.1, 3.1);
  const Point2D m = math::transform(s.pose, {r * std::cos(b), r * std::sin(b)});
  const double std = std::pow(10, random.uniform(-3, 0.5)), c = random.uniform(-0.9, 0.9);
  s.landmark = {m.x, m.y, std * std, 0.5 * c * std * std, 0.25 * std * std, 3, 0};
  s.rangeStd = std::pow(10, random.uniform(-3, 0));
  s.bearingStd = std::pow(10, random.uniform(-4, -1));
  const double off = random.uniform() < 0.5 ? 3 * s.bearingStd : 3.0;
  s.z = {r + 3 * s.rangeStd * random.normal(), math::wrapToPi(b + off * random.normal())};
  return s;
}

bool innovate(const Scene& s, const Ray& ray, Innovation& o)
{
  const auto& m = s.landmark;
  return innovate(Eye(s.pose), ray, m.x, m.y, m.cxx, m.cxy, m.cyy, o);
}
Matrix2 H(const Innovation& o)
{
  return (Matrix2() << o.h11, o.h12, o.h21, o.h22).finished();
}
Matrix2 S(const Innovation& o)
{
  return (Matrix2() << o.s11, o.s12, o.s12, o.s22).finished();
}

/// Equal but for rounding, relative to the larger.
template <class A, class B>
void expectClose(const A& a, const B& b)
{
  EXPECT_LE((a - b).norm(), 1e-12 * std::max(a.norm(), b.norm())) << a << "\n\n" << b;
}
void expectClose(double a, double b)
{
  EXPECT_NEAR(a, b, 1e-11 * std::max({1.0, std::abs(a), std::abs(b)}));
}
}  // namespace

TEST(Innovate, EqualsRangeBearingAndEigen)
{
  RandomStream random{1};
  for (int i = 0; i < 2000; ++i)
  {
    const Scene s = drawScene(random);
    Innovation o;
    ASSERT_TRUE(innovate(s, s.ray(), o));
    const Vector2 nu =
        RangeBearing::residual(s.z, RangeBearing::predict(s.pose, s.landmark.point()));
    EXPECT_NEAR(o.nuR, nu[0], 1e-13 * 40);
    EXPECT_NEAR(math::wrapToPi(o.nuB - nu[1]), 0, 1e-13 * 40);
    const Matrix2 h = RangeBearing::jacobians(s.pose, s.landmark.point()).point;
    expectClose(H(o), h);
    const Matrix2 full = h * s.landmark.cov() * h.transpose() + s.R();
    expectClose(S(o), full);
    expectClose(o.det / full.determinant(), 1.0);
    expectClose(o.d2, Vector2(o.nuR, o.nuB).dot(full.inverse() * Vector2(o.nuR, o.nuB)));
  }
}

TEST(Innovate, OfABearingAloneIsThatOfItsRow)
{
  RandomStream random{2};
  for (int i = 0; i < 500; ++i)
  {
    const Scene s = drawScene(random);
    Innovation both, o;
    ASSERT_TRUE(innovate(s, s.ray(), both));
    ASSERT_TRUE(innovate(s, Ray::ofBearing(s.z[1], s.bearingStd), o));
    EXPECT_EQ(o.nuB, both.nuB);
    EXPECT_EQ(o.nuR, 0);
    expectClose(o.s22, both.s22);
    expectClose(o.det / both.s22, 1.0);
    expectClose(o.d2, both.nuB * both.nuB / both.s22);
  }
}

TEST(Innovate, RefusesRangesWithoutADerivative)
{
  RandomStream random{3};
  Innovation o;
  for (const double range : {1e-9, 0.005, 0.0099})
    EXPECT_FALSE(innovate(drawScene(random, range), drawScene(random).ray(), o));
  const Scene near = drawScene(random, 0.0101);
  ASSERT_TRUE(innovate(near, near.ray(), o));
  expectClose(H(o), RangeBearing::jacobians(near.pose, near.landmark.point()).point);
  EXPECT_TRUE(std::isfinite(o.d2));
}

TEST(WithPose, AddsThePosesOwnUncertainty)
{
  RandomStream random{4};
  for (int i = 0; i < 500; ++i)
  {
    const Scene s = drawScene(random);
    Matrix3 A;
    for (double& a : A.reshaped()) a = 0.1 * random.normal();
    const Matrix3 P = A * A.transpose();
    Innovation o;
    ASSERT_TRUE(innovate(s, s.ray(), o));
    const Innovation p = withPose(o, P);
    const auto J = RangeBearing::jacobians(s.pose, s.landmark.point()).pose;
    const Matrix2 full = S(o) + J * P * J.transpose();
    expectClose(S(p), full);
    expectClose(p.d2, Vector2(o.nuR, o.nuB).dot(full.inverse() * Vector2(o.nuR, o.nuB)));
    expectClose(withPose(o, Matrix3::Zero()).d2, o.d2);
  }
}

TEST(Correct, EqualsAKalmanFilter)
{
  RandomStream random{5};
  for (int i = 0; i < 2000; ++i)
  {
    const Scene s = drawScene(random);
    const bool bearingOnly = i % 4 == 0;
    Innovation o;
    ASSERT_TRUE(innovate(s, bearingOnly ? Ray::ofBearing(s.z[1], s.bearingStd) : s.ray(), o));
    Matrix2 R = s.R();
    if (bearingOnly) R(0, 0) = 1;
    const Matrix2 P = s.landmark.cov(), K = P * H(o).transpose() * S(o).inverse();
    const Vector2 x = Vector2(s.landmark.x, s.landmark.y) + K * Vector2(o.nuR, o.nuB);
    const Matrix2 I = Matrix2::Identity() - K * H(o);
    const Matrix2 joseph = I * P * I.transpose() + K * R * K.transpose();
    maps::Landmark m = s.landmark;
    correct(m, o);
    expectClose(Vector2(m.x, m.y), x);
    // The short form loses digits where the sighting is far better than what was known.
    EXPECT_LE((m.cov() - joseph).norm(), 1e-13 * P.norm());
    EXPECT_EQ(m.sightings, s.landmark.sightings + 1);
  }
}

TEST(Correct, KeepsACovarianceOverManySightings)
{
  RandomStream random{6};
  for (int trial = 0; trial < 50; ++trial)
  {
    Scene s = drawScene(random);
    const Vector2 truth(s.landmark.x, s.landmark.y);
    for (int i = 0; i < 300; ++i)
    {
      s.pose = {random.uniform(-5, 5), random.uniform(-5, 5), random.uniform(-3, 3)};
      const Vector2 z = RangeBearing::predict(s.pose, {truth[0], truth[1]});
      s.z = {z[0] + s.rangeStd * random.normal(), z[1] + s.bearingStd * random.normal()};
      Innovation o;
      if (s.z[0] < 0.1 || !innovate(s, s.ray(), o)) continue;
      correct(s.landmark, o);
      ASSERT_GT(s.landmark.cxx, 0);
      ASSERT_GT(s.landmark.cov().determinant(), 0);
    }
  }
}

TEST(Invert, EqualsRangeBearing)
{
  RandomStream random{7};
  for (int i = 0; i < 500; ++i)
  {
    const Scene s = drawScene(random);
    const Gaussian<Point2D> place = invert(Eye(s.pose), s.ray());
    const Point2D m = RangeBearing::invert(s.pose, s.z);
    EXPECT_NEAR(place.mean.x, m.x, 1e-13 * 40);
    EXPECT_NEAR(place.mean.y, m.y, 1e-13 * 40);
    const Matrix2 J = RangeBearing::invertJacobian(s.pose, s.z);
    expectClose(place.cov, Matrix2(J * s.R() * J.transpose()));
  }
}

TEST(SmallAngle, IsAtan2)
{
  RandomStream random{8};
  for (int i = 0; i < 20000; ++i)
  {
    const double a = i % 2 ? random.uniform(-math::kPi, math::kPi) : random.uniform(-0.11, 0.11);
    const double r = std::pow(10, random.uniform(-2, 2)), y = r * std::sin(a), x = r * std::cos(a);
    EXPECT_NEAR(smallAngle(y, x), std::atan2(y, x), 1e-13);
  }
  EXPECT_EQ(smallAngle(0, 1), 0);
  EXPECT_EQ(smallAngle(0, -1), math::kPi);
}

TEST(LargestEigenvalue, IsEigens)
{
  RandomStream random{9};
  for (int i = 0; i < 200; ++i)
  {
    const Matrix2 C = drawScene(random).landmark.cov();
    EXPECT_NEAR(largestEigenvalue(C(0, 0), C(0, 1), C(1, 1)) /
                    Eigen::SelfAdjointEigenSolver<Matrix2>(C).eigenvalues()[1],
                1, 1e-12);
  }
}

TEST(LogProduct, IsTheSumOfLogsBeyondTheRangeOfDoubles)
{
  RandomStream random{10};
  LogProduct product;
  double sum = 0;
  EXPECT_EQ(product.log(), 0);
  for (int i = 0; i < 2000; ++i)
  {
    const double factor = std::pow(10, random.uniform(-90, i < 1000 ? 5 : 95));
    product.times(factor);
    sum += std::log(factor);
    ASSERT_NEAR(product.log(), sum, 1e-12 * std::max(1.0, std::abs(sum)) + 1e-10);
  }
}
}  // namespace slamot::filters::rbpf
