#include "covariance.h"

#include <slamot/math/random.h>
#include <slamot/math/statistics.h>
#include <slamot/models/RangeBearing.h>
#include <slamot/models/TargetMotion.h>

#include <Eigen/LU>

namespace slamot::models
{
namespace
{
const DifferentialDriveTarget kDrive({1.0, 0.3, 0.3, 0.2, 0.3, 0.3, 0.1, 0.1});
const DampedVelocityTarget kDamped({0.8, 2.0});

/// Takes in what a sensor at the origin sees of a true place; bearing alone if `rangeStd` is 0.
template <class Model>
void see(const Model& model, typename Model::State& s, const Vector2& z, double rangeStd,
         double bearingStd)
{
  const Point2D at = s.point();
  if (std::hypot(at.x, at.y) < 0.1) return;
  const Matrix2 H = RangeBearing::jacobians({}, at).point;
  const Vector2 nu = RangeBearing::residual(z, RangeBearing::predict({}, at));
  if (rangeStd == 0)
  {
    const Eigen::Matrix<double, 1, 2> h = H.row(1);
    const double S = h * s.pointCov() * h.transpose() + bearingStd * bearingStd;
    s.template correct<1>(Eigen::Matrix<double, 1, 1>(nu[1]), Eigen::Matrix<double, 1, 1>(S), h);
    model.afterCorrection(s, nullptr);
    return;
  }
  const Matrix2 R = RangeBearing(rangeStd, bearingStd).noise();
  s.template correct<2>(nu, H * s.pointCov() * H.transpose() + R, H);
  const Matrix2 J = RangeBearing::invertJacobian({}, z);
  const Gaussian<Point2D> seen{RangeBearing::invert({}, z), J * R * J.transpose()};
  model.afterCorrection(s, &seen);
}

template <class Model>
void expectCovariancesOverRandomScripts(const Model& model)
{
  for (std::uint64_t seed = 1; seed <= 100; ++seed)
  {
    SCOPED_TRACE(seed);
    math::RandomStream random{seed};
    const double rangeStd = std::pow(10, random.uniform(-4, 0));
    const double bearingStd = std::pow(10, random.uniform(-4, -1));
    Pose2D truth{random.uniform(-5, 5), random.uniform(-5, 5), random.uniform(-3, 3)};
    auto s = model.birth({{truth.x, truth.y}, 0.01 * Matrix2::Identity()});
    for (int i = 0; i < 60; ++i)
    {
      const double dt = std::pow(10, random.uniform(-3, 0));
      truth = math::compose(truth, math::turnThenMove(1, random.normal(), dt, 0, 0).mean);
      model.predict(s, dt);
      test::expectCovariance(s.P);
      Vector2 z = RangeBearing::predict({}, {truth.x, truth.y});
      z += Vector2(rangeStd * random.normal(), bearingStd * random.normal());
      if (z[0] < 0.2 || random.uniform() < 0.3) continue;
      see(model, s, z, random.uniform() < 0.3 ? 0 : rangeStd, bearingStd);
      test::expectCovariance(s.P);
      test::expectCovariance(Model::pose(s).cov);
      ASSERT_TRUE(s.x.allFinite());
    }
  }
}
}  // namespace

TEST(TargetState, CorrectsAsAKalmanFilterDoes)
{
  TargetState<4> s;
  s.x << 1, 2, 0.5, -0.5;
  Eigen::Matrix4d A;
  A << 1, 0.2, 0, 0.1, -0.3, 0.8, 0.2, 0, 0.5, 0.1, 0.9, 0.2, 0, 0.1, 0.3, 0.7;
  s.P = A * A.transpose();
  Matrix2 h;
  h << 0.3, -0.7, 0.2, 0.4;
  Eigen::Matrix<double, 2, 4> H = Eigen::Matrix<double, 2, 4>::Zero();
  H.leftCols<2>() = h;
  const Matrix2 R = Vector2(0.1, 0.02).asDiagonal();
  const Matrix2 S = H * s.P * H.transpose() + R;
  const Vector2 nu(0.4, -0.1);
  const Eigen::Matrix<double, 4, 2> K = s.P * H.transpose() * S.inverse();
  const Eigen::Vector4d x = s.x + K * nu;
  const Eigen::Matrix4d I = Eigen::Matrix4d::Identity() - K * H;
  const Eigen::Matrix4d P = I * s.P * I.transpose() + K * R * K.transpose();
  s.correct<2>(nu, S, h);
  EXPECT_TRUE(s.x.isApprox(x, 1e-12));
  EXPECT_TRUE(s.P.isApprox(P, 1e-12));
}

TEST(TargetState, StaysACovarianceWithTheDifferentialDrive)
{
  expectCovariancesOverRandomScripts(kDrive);
}

TEST(TargetState, StaysACovarianceWithTheDampedVelocity)
{
  expectCovariancesOverRandomScripts(kDamped);
}

// Born without a heading, it shows one after some metres, right within what it says.
TEST(DifferentialDrive, BornWithoutAHeadingFindsOne)
{
  constexpr int kRuns = 200;
  const DifferentialDriveTarget model({1.0, 0.2, 0.3, 0.0, 0.0, 0.0, 0.0, 0.0});
  double heading = 0, place = 0;
  for (std::uint64_t seed = 1; seed <= kRuns; ++seed)
  {
    math::RandomStream random{seed, 5};
    const double a = random.uniform(-3, 3), v = 1.0 + 0.2 * random.normal();
    Pose2D truth{6 * std::cos(a), 6 * std::sin(a), random.uniform(-3, 3)};
    const auto sight = [&]() -> Vector2
    {
      return RangeBearing::predict({}, {truth.x, truth.y}) +
             Vector2(0.05 * random.normal(), 0.01 * random.normal());
    };
    const Vector2 first = sight();
    const Matrix2 J = RangeBearing::invertJacobian({}, first);
    auto s = model.birth(
        {RangeBearing::invert({}, first), J * RangeBearing(0.05, 0.01).noise() * J.transpose()});
    for (int i = 1; i <= 10; ++i)
    {
      truth = math::compose(truth, math::turnThenMove(v, 0.3, 0.1, 0, 0).mean);
      model.predict(s, 0.1);
      see(model, s, sight(), 0.05, 0.01);
    }
    ASSERT_TRUE(s.headed);
    const auto pose = DifferentialDriveTarget::pose(s);
    const Vector3 e(truth.x - pose.mean.x, truth.y - pose.mean.y,
                    math::wrapToPi(truth.phi - pose.mean.phi));
    heading += e[2] * e[2] / pose.cov(2, 2);
    place += math::mahalanobisSquared(e.head<2>(), pose.cov.topLeftCorner<2, 2>());
  }
  // Correlations lost when the heading is set make it a little too sure or unsure, not by much.
  EXPECT_GT(heading, 0.5 * math::chiSquareQuantile(0.001, kRuns));
  EXPECT_LT(heading, 1.5 * math::chiSquareQuantile(0.999, kRuns));
  EXPECT_LT(place, 1.5 * math::chiSquareQuantile(0.999, 2 * kRuns));
}

TEST(DifferentialDrive, ThatStandsStillGetsNoHeadingFromNoise)
{
  int headed = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed)
  {
    math::RandomStream random{seed, 6};
    auto s = DifferentialDriveTarget({0.0, 0.5, 0, 0, 0, 0, 0, 0})
                 .birth({{4, 0}, (Matrix2() << 0.01, 0, 0, 0.0016).finished()});
    for (int i = 0; i < 20; ++i)
    {
      kDrive.predict(s, 0.1);
      see(kDrive, s, {4 + 0.1 * random.normal(), 0.01 * random.normal()}, 0.1, 0.01);
    }
    headed += s.headed;
  }
  // Three deviations across the ray, 20 tries a run that share their anchor: some 2% of the runs.
  EXPECT_LE(headed, 10);
}

TEST(DifferentialDrive, ABearingAloneNeitherTurnsNorHeads)
{
  auto s = kDrive.birth({{4, 1}, 0.01 * Matrix2::Identity()});
  kDrive.predict(s, 1.0);
  const double before = s.pointCov().trace();
  see(kDrive, s, {1.0, 0.3}, 0, 0.01);
  EXPECT_FALSE(s.headed);
  EXPECT_EQ(s.x[2], 0);
  EXPECT_LT(s.pointCov().trace(), before);
}
}  // namespace slamot::models
