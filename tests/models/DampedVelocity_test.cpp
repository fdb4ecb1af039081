#include "covariance.h"

#include <slamot/models/TargetMotion.h>

namespace slamot::models
{
namespace
{
using Model = DampedVelocityTarget;
using Start = core::ObjectStart;

constexpr double kStd = 0.7, kTime = 3.0;
const Model kModel({kStd, kTime});

Model::State someState()
{
  Model::State s;
  s.x << 1, -2, 0.6, -0.3;
  Eigen::Matrix4d A;
  A << 1, 0.2, 0, 0.1, -0.3, 0.8, 0.2, 0, 0.5, 0.1, 0.9, 0.2, 0, 0.1, 0.3, 0.7;
  s.P = 0.05 * A * A.transpose();
  return s;
}

Model::State predicted(Model::State s, double dt, int parts = 1)
{
  for (int i = 0; i < parts; ++i) kModel.predict(s, dt / parts);
  return s;
}

/// The same process by its differential equations, Runge and Kutta's way.
Model::State integrated(Model::State s, double dt)
{
  Eigen::Matrix4d A = Eigen::Matrix4d::Zero(), W = Eigen::Matrix4d::Zero();
  A(0, 2) = A(1, 3) = 1;
  A(2, 2) = A(3, 3) = -1 / kTime;
  W(2, 2) = W(3, 3) = 2 * kStd * kStd / kTime;
  const auto slope = [&](const Eigen::Matrix4d& P) -> Eigen::Matrix4d
  { return A * P + P * A.transpose() + W; };
  constexpr int kParts = 400;
  const double h = dt / kParts;
  for (int i = 0; i < kParts; ++i)
  {
    const Eigen::Matrix4d k1 = slope(s.P), k2 = slope(s.P + h / 2 * k1),
                          k3 = slope(s.P + h / 2 * k2), k4 = slope(s.P + h * k3);
    s.P += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    const Eigen::Vector4d m1 = A * s.x, m2 = A * (s.x + h / 2 * m1), m3 = A * (s.x + h / 2 * m2),
                          m4 = A * (s.x + h * m3);
    s.x += h / 6 * (m1 + 2 * m2 + 2 * m3 + m4);
  }
  return s;
}
}  // namespace

TEST(DampedVelocity, SolvesItsDifferentialEquations)
{
  for (const double dt : {0.01, 0.5, 4.0})
  {
    const auto a = predicted(someState(), dt), b = integrated(someState(), dt);
    EXPECT_TRUE(a.x.isApprox(b.x, 1e-9));
    EXPECT_TRUE(a.P.isApprox(b.P, 1e-9)) << a.P << "\n\n" << b.P;
  }
}

TEST(DampedVelocity, HalfStepsEqualAWholeOne)
{
  for (const double dt : {1e-3, 0.1, 2.0, 50.0})
    for (const int parts : {2, 7})
    {
      const auto a = predicted(someState(), dt), b = predicted(someState(), dt, parts);
      EXPECT_TRUE(a.x.isApprox(b.x, 1e-12));
      EXPECT_TRUE(a.P.isApprox(b.P, 1e-12)) << a.P << "\n\n" << b.P;
    }
}

// The noise of a short step is a difference of nearly equal numbers: 2/3 v² dt³ / T is what is
// left.
TEST(DampedVelocity, KeepsTheNoiseOfShortStepsExact)
{
  for (double dt = 1e-7; dt < 0.02; dt *= 1.7)
  {
    Model::State s;
    kModel.predict(s, dt);
    const double x = dt / kTime;
    const double series = kStd * kStd * kTime * kTime * x * x * x *
                          (2.0 / 3 - x / 2 + 7 * x * x / 30 - x * x * x / 12);
    EXPECT_NEAR(s.P(0, 0) / series, 1, 1e-7) << dt;
    test::expectCovariance(s.P);
  }
}

TEST(DampedVelocity, ForgetsItsVelocityAndStaysNearItsPlace)
{
  const auto s = predicted(someState(), 100 * kTime);
  EXPECT_NEAR(s.x[0], 1 + 0.6 * kTime, 1e-12);
  EXPECT_NEAR(s.x[2], 0, 1e-12);
  EXPECT_NEAR(s.P(2, 2), kStd * kStd, 1e-12);
  EXPECT_NEAR(s.P(2, 3), 0, 1e-12);
}

TEST(DampedVelocity, StartsWithWhatIsKnown)
{
  Start start;
  start.value = {1.0, 2.0, std::nullopt, 0.5, std::nullopt, std::nullopt, std::nullopt};
  start.std = {0.1, 0.2, std::nullopt, 0.3, std::nullopt, std::nullopt, std::nullopt};
  const auto s = kModel.start(start);
  EXPECT_EQ(s.x, Eigen::Vector4d(1, 2, 0.5, 0));
  EXPECT_TRUE(
      s.P.isApprox(Eigen::Matrix4d(Eigen::Vector4d(0.01, 0.04, 0.09, kStd * kStd).asDiagonal())));
}

TEST(DampedVelocity, IsBornAtRestWithTheDeviationOfTheLongRun)
{
  const Gaussian<Point2D> place{{3, 4}, (Matrix2() << 0.2, 0.1, 0.1, 0.3).finished()};
  const auto s = kModel.birth(place);
  EXPECT_EQ(s.x, Eigen::Vector4d(3, 4, 0, 0));
  EXPECT_EQ(s.pointCov(), place.cov);
  EXPECT_EQ((s.P.bottomRightCorner<2, 2>()), Matrix2(kStd * kStd * Matrix2::Identity()));
  EXPECT_TRUE((s.P.topRightCorner<2, 2>().isZero()));
}

TEST(DampedVelocity, HeadingIsTheCourseAndUnknownAtRest)
{
  auto s = someState();
  s.P.bottomRightCorner<2, 2>() = 1e-4 * Matrix2::Identity();
  const auto pose = Model::pose(s);
  EXPECT_DOUBLE_EQ(pose.mean.phi, std::atan2(-0.3, 0.6));
  EXPECT_NEAR(pose.cov(2, 2), 1e-4 / 0.45, 1e-12);
  s.x.tail<2>().setZero();
  EXPECT_NEAR(Model::pose(s).cov(2, 2), math::kPi * math::kPi / 3, 1e-12);
  Matrix2 cov;
  EXPECT_EQ(Model::velocity(someState(), cov), Vector2(0.6, -0.3));
  EXPECT_EQ(cov, (someState().P.bottomRightCorner<2, 2>()));
}

TEST(DampedVelocity, ReadsItsParameters)
{
  core::Config c = core::Config::parse(
      "[f]\ntarget_motion = damped-velocity\ntarget_velocity_std_mps = 0.5\n"
      "target_velocity_time_s = 2\n",
      "x.ini");
  core::Params p(c, "f");
  const TargetMotion motion = targetMotionFrom(p);
  c.requireAllRead();
  const auto* model = std::get_if<Model>(&motion);
  ASSERT_TRUE(model);
  EXPECT_EQ(model->birth({}).P(2, 2), 0.25);
}
}  // namespace slamot::models
