#include "covariance.h"

#include <slamot/models/TargetMotion.h>

namespace slamot::models
{
namespace
{
using Model = DifferentialDriveTarget;
using Start = core::ObjectStart;
using Matrix5 = Eigen::Matrix<double, 5, 5>;
using Vector5 = Eigen::Matrix<double, 5, 1>;

//                   speed, std, turn rate, std, noises, walks
const Model kModel({1.2, 0.3, 0.4, 0.2, 0.5, 0.6, 0.1, 0.05});

Model::State someState()
{
  Model::State s;
  s.x << 1, -2, 2.9, 1.1, 0.5;
  Matrix5 A;
  A << 1, 0.2, 0, 0.1, 0.3, -0.3, 0.8, 0.2, 0, 0.1, 0.5, 0.1, 0.9, 0.2, 0, 0, 0.1, 0.3, 0.7, 0.2,
      0.1, 0, 0.2, 0.1, 0.6;
  s.P = 0.05 * A * A.transpose();
  return s;
}

Vector5 moved(const Vector5& x, double dt)
{
  Model::State s;
  s.x = x;
  kModel.predict(s, dt);
  return s.x;
}
}  // namespace

TEST(DifferentialDrive, PredictsByItsDerivatives)
{
  constexpr double dt = 0.3, h = 1e-6;
  Model::State s = someState();
  const Model::State before = s;
  kModel.predict(s, dt);
  Matrix5 F;
  for (int i = 0; i < 5; ++i)
  {
    const Vector5 e = h * Vector5::Unit(i);
    Vector5 d = moved(before.x + e, dt) - moved(before.x - e, dt);
    d[2] = math::wrapToPi(d[2]);
    F.col(i) = d / (2 * h);
  }
  // Noise of (v, omega) over this step moves the pose as v and omega themselves do; walks add up.
  const Eigen::Matrix<double, 3, 2> G = F.topRightCorner<3, 2>();
  Matrix5 expected = F * before.P * F.transpose();
  expected.topLeftCorner<3, 3>() += G * Vector2(0.25, 0.36).asDiagonal() * G.transpose();
  expected(3, 3) += 0.01 * dt;
  expected(4, 4) += 0.0025 * dt;
  EXPECT_TRUE(s.P.isApprox(expected, 1e-8)) << s.P << "\n\n" << expected;
  test::expectCovariance(s.P);
}

// With known v and omega it is the motion of a robot with odometry.
TEST(DifferentialDrive, EqualsComposedTurnThenMove)
{
  const Model known({1.2, 0, 0.4, 0, 0.5, 0.6, 0, 0});
  Start start;
  start.value = {1.0, 2.0, -0.5};
  start.std = {0.1, 0.2, 0.3};
  Model::State s = known.start(start);
  Gaussian<Pose2D> pose = start.pose();
  for (int i = 0; i < 30; ++i)
  {
    known.predict(s, 0.1);
    pose = math::compose(pose, math::turnThenMove(1.2, 0.4, 0.1, 0.5, 0.6));
    const auto got = Model::pose(s);
    EXPECT_NEAR(got.mean.x, pose.mean.x, 1e-12);
    EXPECT_NEAR(got.mean.y, pose.mean.y, 1e-12);
    EXPECT_NEAR(got.mean.phi, pose.mean.phi, 1e-12);
    EXPECT_TRUE(got.cov.isApprox(pose.cov, 1e-12));
  }
}

TEST(DifferentialDrive, StartsWithWhatIsKnown)
{
  Start start;
  start.value = {1.0, 2.0, 4.0};
  start.std = {0.1, 0.2, 0.3};
  auto s = kModel.start(start);
  EXPECT_TRUE(s.headed);
  EXPECT_NEAR(s.x[2], 4 - math::kTwoPi, 1e-15);
  EXPECT_EQ(s.x[3], 1.2);
  EXPECT_TRUE(
      s.P.diagonal().isApprox((Vector5() << 0.01, 0.04, 0.09, 0.09, 0.04).finished(), 1e-12));
  start.value[Start::kVx] = 3;
  start.value[Start::kVy] = -4;
  start.std[Start::kVx] = start.std[Start::kVy] = 0.5;
  s = kModel.start(start);
  EXPECT_DOUBLE_EQ(s.x[3], 5);
  EXPECT_DOUBLE_EQ(s.P(3, 3), 0.25);
  EXPECT_NEAR(s.x[2], 4 - math::kTwoPi, 1e-15);
}

TEST(DifferentialDrive, TakesAnUnknownHeadingFromAKnownVelocity)
{
  Start start;
  start.value = {1.0, 2.0, std::nullopt, 3.0, -4.0};
  start.std = {0.1, 0.1, std::nullopt, 0.5, 0.5};
  const auto s = kModel.start(start);
  EXPECT_TRUE(s.headed);
  EXPECT_DOUBLE_EQ(s.x[2], std::atan2(-4, 3));
  EXPECT_DOUBLE_EQ(s.P(2, 2), 0.25 / 25);
}

TEST(DifferentialDrive, WaitsWithoutAHeading)
{
  Start start;
  start.value = {1.0, 2.0};
  start.std = {0.1, 0.1};
  EXPECT_FALSE(kModel.start(start).headed);
  const auto born = kModel.birth({{1, 2}, 0.01 * Matrix2::Identity()});
  EXPECT_FALSE(born.headed);
  EXPECT_NEAR(Model::pose(born).cov(2, 2), math::kPi * math::kPi / 3, 1e-12);
}

// Nothing is known of the direction but that it stays: the place spreads by v t / sqrt 2 an axis.
TEST(DifferentialDrive, SpreadsWithoutAHeadingAsAnUnknownDirectionDoes)
{
  for (const int parts : {1, 2, 10, 100})
  {
    auto s = Model({1.2, 0, 0, 0, 0, 0, 0, 0}).birth({});
    const Model model({1.2, 0, 0, 0, 0, 0, 0, 0});
    for (int i = 0; i < parts; ++i) model.predict(s, 2.0 / parts);
    EXPECT_NEAR(s.P(0, 0), 2.4 * 2.4 / 2, 1e-12) << parts;
    EXPECT_NEAR(s.P(1, 1), s.P(0, 0), 1e-12);
    EXPECT_EQ(s.x[0], 0);
  }
}

TEST(DifferentialDrive, ReportsNoMoreThanAnUnknownHeading)
{
  auto s = someState();
  s.P *= 1e3;
  const auto pose = Model::pose(s);
  EXPECT_NEAR(pose.cov(2, 2), math::kPi * math::kPi / 3, 1e-12);
  EXPECT_EQ((pose.cov.topLeftCorner<2, 2>()), s.pointCov());
  test::expectCovariance(pose.cov);
}

TEST(DifferentialDrive, VelocityFollowsItsDerivatives)
{
  constexpr double h = 1e-6;
  const auto s = someState();
  Matrix2 cov, ignored, J;
  const Vector2 v = Model::velocity(s, cov);
  EXPECT_NEAR(v[0], 1.1 * std::cos(2.9), 1e-15);
  EXPECT_NEAR(v[1], 1.1 * std::sin(2.9), 1e-15);
  for (int i = 0; i < 2; ++i)
  {
    auto a = s, b = s;
    a.x[2 + i] -= h;
    b.x[2 + i] += h;
    J.col(i) = (Model::velocity(b, ignored) - Model::velocity(a, ignored)) / (2 * h);
  }
  EXPECT_TRUE(cov.isApprox(J * s.P.block<2, 2>(2, 2) * J.transpose(), 1e-8));
}

TEST(DifferentialDrive, ReadsItsParameters)
{
  core::Config c = core::Config::parse(
      "[f]\ntarget_motion = differential-drive\ntarget_speed_mps = 2\n"
      "target_turn_rate_deg_per_s = -90\ntarget_speed_noise_mps = 0.8\n"
      "target_turn_rate_noise_deg_per_s = 30\n",
      "x.ini");
  core::Params p(c, "f");
  const TargetMotion motion = targetMotionFrom(p);
  c.requireAllRead();
  const auto* model = std::get_if<Model>(&motion);
  ASSERT_TRUE(model);
  const auto s = model->birth({});
  EXPECT_EQ(s.x[3], 2);
  EXPECT_DOUBLE_EQ(s.x[4], -math::kPi / 2);
  EXPECT_TRUE((s.P.bottomRightCorner<2, 2>().isZero()));
}
}  // namespace slamot::models
