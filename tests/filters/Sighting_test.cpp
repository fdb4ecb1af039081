#include "sighting/unscentedSighting.h"

#include "LinearSighting.h"

#include <gtest/gtest.h>
#include <slamot/math/gaussian.h>
#include <slamot/math/random.h>

#include <Eigen/LU>

// The inner loop is written out by hand; RangeBearing and Eigen are the readable form.
namespace slamot::filters
{
namespace
{
using math::RandomStream;
using models::RangeBearing;
using test::LinearSighting;

struct Scene
{
  Pose2D pose;
  maps::Landmark landmark;
  Vector2 z;
  double rangeStd, bearingStd;

  [[nodiscard]] Ray ray() const { return Ray::of(z[0], z[1], rangeStd, bearingStd); }
  [[nodiscard]] Ray bearingAlone() const { return Ray::ofBearing(z[1], bearingStd); }
  [[nodiscard]] RangeBearing model() const { return {rangeStd, bearingStd}; }
  [[nodiscard]] Matrix2 R() const { return model().noise(); }
  [[nodiscard]] double distance() const
  {
    return std::hypot(landmark.x - pose.x, landmark.y - pose.y);
  }
  /// The distance beyond which polar coordinates are taken.
  [[nodiscard]] double switchAt() const
  {
    return 8 * std::sqrt(landmark.cov().trace() + rangeStd * rangeStd);
  }
  [[nodiscard]] LinearSighting linear() const
  {
    return test::linearise(pose, landmark.point(), landmark.cov(), z, model());
  }
  [[nodiscard]] LinearSighting polar() const
  {
    return test::inPolar(pose, landmark.point(), z, model());
  }
};

/// A landmark at a given range, as uncertain as may be, and a sighting that is near its own point
/// or anywhere.
Scene drawSceneAt(RandomStream& random, double r, double std, double rangeStd)
{
  Scene s;
  s.pose = {random.uniform(-5, 5), random.uniform(-5, 5), random.uniform(-math::kPi, math::kPi)};
  const double b = random.uniform(-3.1, 3.1);
  const Point2D m = math::transform(s.pose, {r * std::cos(b), r * std::sin(b)});
  const double c = random.uniform(-0.9, 0.9);
  s.landmark = {m.x, m.y, std * std, 0.5 * c * std * std, 0.25 * std * std, 3, 0};
  s.rangeStd = rangeStd;
  s.bearingStd = std::pow(10, random.uniform(-4, -1));
  const double off = random.uniform() < 0.5 ? 3 * s.bearingStd : 3.0;
  s.z = {std::abs(r + 3 * s.rangeStd * random.normal()), math::wrapToPi(b + off * random.normal())};
  return s;
}

/// Nearer than eight deviations of point and range together, or farther (and beyond 1 cm).
Scene drawScene(RandomStream& random, bool near)
{
  const double std = std::pow(10, random.uniform(-3, 0.5));
  const double rangeStd = std::pow(10, random.uniform(-3, 0));
  const double switchAt = 8 * std::sqrt(1.25 * std * std + rangeStd * rangeStd);
  const double r = near ? switchAt * random.uniform(0, 0.999)
                        : std::max(0.0101, switchAt * std::pow(10, random.uniform(0.001, 1.5)));
  return drawSceneAt(random, r, std, rangeStd);
}

bool innovate(const Scene& s, const Ray& ray, Innovation& o, double noise = 1)
{
  const auto& m = s.landmark;
  return innovate(Eye(s.pose), ray, m.x, m.y, m.cxx, m.cxy, m.cyy, o, noise);
}
Innovation innovation(const Scene& s, const Ray& ray, double noise = 1)
{
  Innovation o{};
  EXPECT_TRUE(innovate(s, ray, o, noise));
  return o;
}
Vector2 nu(const Innovation& o)
{
  return {o.nuR, o.nuB};
}
Matrix2 H(const Innovation& o)
{
  return (Matrix2() << o.h11, o.h12, o.h21, o.h22).finished();
}
Vector2 turn(const Innovation& o)
{
  return {o.turnR, o.turnB};
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

/// Derivative at 0 of a function of one number, to the fourth order in the step.
template <class F>
Vector2 derivative(const F& f, double step)
{
  return (8 * (f(step) - f(-step)) - (f(2 * step) - f(-2 * step))) / (12 * step);
}

class Innovate : public ::testing::TestWithParam<bool>  // of a near point?
{
};
INSTANTIATE_TEST_SUITE_P(Of, Innovate, ::testing::Bool(),
                         [](const auto& test) { return test.param ? "Near" : "Far"; });
}  // namespace

TEST_P(Innovate, EqualsTheDefinition)
{
  RandomStream random{1};
  for (int i = 0; i < 2000; ++i)
  {
    const Scene s = drawScene(random, GetParam());
    const Innovation o = innovation(s, s.ray());
    const LinearSighting expected = s.linear();
    ASSERT_EQ(expected.near, GetParam());
    EXPECT_NEAR(o.nuR, expected.nu[0], 1e-13 * 40);
    EXPECT_NEAR(math::wrapToPi(o.nuB - expected.nu[1]), 0, 1e-13 * 40);
    expectClose(H(o), expected.byPoint);
    expectClose(turn(o), expected.byPose.col(2));
    const Matrix2 full = expected.S(s.landmark.cov());
    expectClose(S(o), full);
    expectClose(o.det / full.determinant(), 1.0);
    expectClose(o.d2, nu(o).dot(full.inverse() * nu(o)));
  }
}

// Also by the heading, with which the ray turns: what a pose's proposal and its gates live on.
TEST_P(Innovate, HasTheDerivativesOfItsInnovation)
{
  RandomStream random{11};
  int tried = 0;
  for (int i = 0; i < 2000; ++i)
  {
    Scene s = drawScene(random, GetParam());
    const Innovation o = innovation(s, s.ray());
    // Away from the switch, and from a bearing straight behind, where it wraps.
    const double r = s.distance(), step = 1e-3 * std::min(r, std::abs(r - s.switchAt()));
    if (step < 1e-6 || (!GetParam() && std::abs(o.nuB) > 3)) continue;
    ++tried;
    const auto moved = [&](double& number, double by)
    {
      const double before = number;
      number += by;
      const Vector2 out = nu(innovation(s, s.ray()));
      number = before;
      return out;
    };
    // The innovation falls as what is expected rises.
    const auto by = [&](double& number, double h) -> Vector2
    { return -derivative([&](double x) { return moved(number, x); }, h); };
    const double scale = H(o).norm(), rounding = 1e-13 * (1 + r) * (1 + scale) / step;
    const double tolerance = 1e-9 * scale + rounding;
    EXPECT_LE((by(s.landmark.x, step) - H(o).col(0)).norm(), tolerance);
    EXPECT_LE((by(s.landmark.y, step) - H(o).col(1)).norm(), tolerance);
    EXPECT_LE((by(s.pose.x, step) + H(o).col(0)).norm(), tolerance);
    EXPECT_LE((by(s.pose.y, step) + H(o).col(1)).norm(), tolerance);
    EXPECT_LE((by(s.pose.phi, 1e-3) - turn(o)).norm(), 1e-9 * (1 + turn(o).norm()));
  }
  EXPECT_GT(tried, 1500);
}

// A bearing alone is taken in polar coordinates wherever the point is, and its range's row is
// inert.
TEST_P(Innovate, OfABearingAloneIsThatOfItsRow)
{
  RandomStream random{2};
  for (int i = 0; i < 500; ++i)
  {
    const Scene s = drawScene(random, GetParam());
    if (s.distance() < RangeBearing::kSmallestRange) continue;
    Innovation o{};
    const LinearSighting both = s.polar();
    const double noise = i % 2 ? 1 : std::pow(10, random.uniform(0, 3));
    ASSERT_TRUE(innovate(s, s.bearingAlone(), o, noise));
    EXPECT_NEAR(math::wrapToPi(o.nuB - both.nu[1]), 0, 1e-13 * 40);
    expectClose(H(o).row(1), both.byPoint.row(1));
    EXPECT_EQ(turn(o), Vector2(0, -1));
    EXPECT_EQ(o.nuR, 0);
    EXPECT_TRUE(H(o).row(0).isZero(0));
    const double s22 = both.S(s.landmark.cov())(1, 1) + (noise - 1) * both.R(1, 1);
    expectClose(o.s22 / s22, 1.0);
    expectClose(o.det / s22, 1.0);
    expectClose(o.d2, o.nuB * o.nuB / s22);
  }
}

TEST_P(Innovate, MultipliesTheSightingsVariances)
{
  RandomStream random{12};
  for (int i = 0; i < 200; ++i)
  {
    const Scene s = drawScene(random, GetParam());
    const double noise = std::pow(10, random.uniform(0, 3));
    const Innovation one = innovation(s, s.ray()), many = innovation(s, s.ray(), noise);
    EXPECT_EQ(nu(many), nu(one));
    EXPECT_EQ(H(many), H(one));
    expectClose(S(many), Matrix2(S(one) + (noise - 1) * s.R()));
  }
}

TEST(Innovate, NearTheRobotNeedsARange)
{
  RandomStream random{3};
  Innovation o{};
  for (const double range : {1e-9, 0.005, 0.0099})
  {
    const Scene s = drawSceneAt(random, range, 0.03, 0.02);
    ASSERT_TRUE(innovate(s, s.ray(), o));
    ASSERT_TRUE(s.linear().near);
    expectClose(H(o), s.linear().byPoint);
    expectClose(S(o), s.linear().S(s.landmark.cov()));
    EXPECT_TRUE(std::isfinite(o.d2));
    EXPECT_FALSE(innovate(s, s.bearingAlone(), o));
  }
  // Point and range known so well that even this is eight deviations away: polar, so refused.
  for (const double range : {0.005, 0.0099})
  {
    const Scene exact = drawSceneAt(random, range, 1e-4, 1e-4);
    EXPECT_FALSE(innovate(exact, exact.ray(), o));
  }
  const Scene beyond = drawSceneAt(random, 0.0101, 1e-4, 1e-4);
  ASSERT_TRUE(innovate(beyond, beyond.ray(), o));
  expectClose(H(o), beyond.polar().byPoint);
  EXPECT_TRUE(std::isfinite(o.d2));
  EXPECT_TRUE(innovate(beyond, beyond.bearingAlone(), o));
}

TEST(Innovate, IsDefinedWhereTheRobotStandsOnThePoint)
{
  const Scene s{{1, 2, 0.3}, {1, 2, 0.01, 0, 0.02, 1, 0}, {0.05, 0.7}, 0.1, 0.02};
  const Innovation o = innovation(s, s.ray());
  EXPECT_EQ(o.nuR, 0.05);
  EXPECT_EQ(o.nuB, 0);
  EXPECT_GT(o.det, 0);
  EXPECT_TRUE(turn(o).isZero(0));
  Innovation none{};
  EXPECT_FALSE(innovate(s, s.bearingAlone(), none));
}

TEST(WithPose, AddsThePosesOwnUncertainty)
{
  RandomStream random{4};
  for (int i = 0; i < 500; ++i)
  {
    const Scene s = drawScene(random, i % 2 == 0);
    Matrix3 A;
    for (double& a : A.reshaped()) a = 0.1 * random.normal();
    const Matrix3 P = A * A.transpose();
    const Innovation o = innovation(s, s.ray());
    const Innovation p = withPose(o, P);
    const auto J = s.linear().byPose;
    const Matrix2 full = S(o) + J * P * J.transpose();
    expectClose(S(p), full);
    expectClose(p.d2, nu(o).dot(full.inverse() * nu(o)));
    expectClose(withPose(o, Matrix3::Zero()).d2, o.d2);
  }
}

TEST(IsBeyond, RejectsOnlyWhatEveryFrameRejects)
{
  constexpr double kGate = 13.8;
  RandomStream random{6};
  int beyond = 0, outside = 0;
  for (int i = 0; i < 20000; ++i)
  {
    const Scene s = drawScene(random, i % 2 == 0);
    Matrix3 A;
    for (int row = 0; row < 3; ++row)
      A.row(row) = std::pow(10, random.uniform(-3, row < 2 ? 0.5 : 0)) * random.normal3();
    const Matrix3 P = A * A.transpose();
    const auto& m = s.landmark;
    const Eye eye(s.pose);
    for (const Matrix3* pose : {static_cast<const Matrix3*>(nullptr), &P})
    {
      const bool rejected = isBeyond(kGate, eye, s.ray(), m.x, m.y, m.cxx, m.cyy, pose);
      Innovation polar = innovation(s, s.ray()), unscented{};
      ASSERT_TRUE(innovateUnscented(eye, s.ray(), m.x, m.y, m.cxx, m.cxy, m.cyy, pose, unscented));
      if (pose)
      {
        polar = withPose(polar, P);
        unscented = withPose(unscented, P);
      }
      if (rejected)
      {
        EXPECT_GT(std::min(polar.d2, unscented.d2), kGate) << "scene " << i;
      }
      beyond += rejected ? 1 : 0;
      outside += std::min(polar.d2, unscented.d2) > kGate ? 1 : 0;
    }
    EXPECT_FALSE(isBeyond(kGate, eye, s.bearingAlone(), m.x, m.y, m.cxx, m.cyy, nullptr));
  }
  EXPECT_GT(beyond, 0.5 * outside);  // or it would be of little use
}

TEST(Correct, EqualsAKalmanFilter)
{
  RandomStream random{5};
  for (int i = 0; i < 2000; ++i)
  {
    const Scene s = drawScene(random, i % 2 == 0);
    const bool bearingOnly = i % 4 > 1 && s.distance() > RangeBearing::kSmallestRange;
    Innovation o;
    ASSERT_TRUE(innovate(s, bearingOnly ? s.bearingAlone() : s.ray(), o));
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
    Scene s = drawScene(random, trial % 2 == 0);
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
    const Scene s = drawScene(random, i % 2 == 0);
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
    const Matrix2 C = drawScene(random, true).landmark.cov();
    EXPECT_NEAR(largestEigenvalue(C(0, 0), C(0, 1), C(1, 1)) / std::pow(math::ellipse(C).longer, 2),
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
}  // namespace slamot::filters
