#include "rbpf/PoseUpdate.h"

#include "LinearSighting.h"
#include "denseKalman.h"

#include <gtest/gtest.h>
#include <slamot/math/gaussian.h>
#include <slamot/math/random.h>

namespace slamot::filters::rbpf
{
namespace
{
using math::RandomStream;
using models::RangeBearing;

Matrix3 drawPrior(RandomStream& random, int rank)
{
  Matrix3 A = Matrix3::Zero();
  for (int i = 0; i < rank; ++i) A.col(i) << random.normal(), random.normal(), random.normal();
  return 0.01 * A * A.transpose();
}

/// The dense joint Gaussian of a pose and its landmarks, linearised as PoseUpdate does.
struct Dense
{
  explicit Dense(int landmarks)
      : P(Eigen::MatrixXd::Zero(3 + 2 * landmarks, 3 + 2 * landmarks)),
        H(Eigen::MatrixXd::Zero(2 * landmarks, 3 + 2 * landmarks)),
        R(Eigen::MatrixXd::Zero(2 * landmarks, 2 * landmarks)),
        nu(2 * landmarks)
  {
  }
  Eigen::MatrixXd P, H, R;
  Eigen::VectorXd nu;
  double atPrior = 0;  // log likelihood of the sightings if the pose were the prior's mean
};

/// Landmarks near by and far away in turn.
Dense draw(RandomStream& random, int landmarks, const Matrix3& P0, PoseUpdate& update)
{
  const RangeBearing model(0.1, 0.02);
  Dense d(landmarks);
  d.P.topLeftCorner<3, 3>() = P0;
  const Pose2D x0{1, -2, random.uniform(-3, 3)};
  for (int i = 0; i < landmarks; ++i)
  {
    const bool near = i % 2 == 0;
    const double r = near ? random.uniform(0.05, 1.9) : random.uniform(2, 8);
    const double a = random.uniform(-3, 3);
    const Point2D m{x0.x + r * std::cos(a), x0.y + r * std::sin(a)};
    const double c = random.uniform(-0.9, 0.9) * 0.02;
    const Matrix2 C = (Matrix2() << 0.02, c, c, 0.03).finished();
    const Vector2 error(0.1 * random.normal(), 0.05 * random.normal());
    const Vector2 z = (RangeBearing::predict(x0, m) + error).cwiseMax(Vector2(0.01, -10));
    Innovation o{};
    EXPECT_TRUE(
        innovate(Eye(x0), Ray::of(z[0], z[1], 0.1, 0.02), m.x, m.y, C(0, 0), c, C(1, 1), o));
    update.add(o);
    const auto s = test::linearise(x0, m, C, z, model);
    EXPECT_EQ(s.near, near);
    d.P.block<2, 2>(3 + 2 * i, 3 + 2 * i) = C;
    d.H.block<2, 3>(2 * i, 0) = s.byPose;
    d.H.block<2, 2>(2 * i, 3 + 2 * i) = s.byPoint;
    d.R.block<2, 2>(2 * i, 2 * i) = s.R;
    d.nu.segment<2>(2 * i) = s.nu;
    d.atPrior += test::logNormal(s.nu, s.S(C));
  }
  return d;
}
}  // namespace

// Also for priors of rank two (a control with two noises), one, and none (a pose that is known).
TEST(PoseUpdate, EqualsTheDenseJointGaussian)
{
  RandomStream random{1};
  for (int trial = 0; trial < 400; ++trial)
  {
    const int rank = trial % 4, landmarks = 1 + trial % 6;
    const Matrix3 P0 = drawPrior(random, rank);
    PoseUpdate update;
    const Dense d = draw(random, landmarks, P0, update);
    const test::DenseUpdate expected(d.P, d.H, d.R, d.nu);
    const auto r = update.solve(math::squareRoot(P0));
    EXPECT_LE((r.shift - test::times(expected.gain, d.nu).topRows<3>()).norm(), 1e-11);
    EXPECT_LE((r.root * r.root.transpose() - expected.cov.topLeftCorner<3, 3>()).norm(),
              1e-11 * (1e-3 + P0.norm()));
    EXPECT_NEAR(r.logGain, expected.logDensity - d.atPrior, 1e-8 * (1 + std::abs(d.atPrior)));
  }
}

TEST(PoseUpdate, WithoutSightingsKeepsThePrior)
{
  RandomStream random{2};
  const Matrix3 P0 = drawPrior(random, 3);
  const auto r = PoseUpdate().solve(math::squareRoot(P0));
  EXPECT_TRUE(r.shift.isZero());
  EXPECT_TRUE((r.root * r.root.transpose()).isApprox(P0, 1e-14));
  EXPECT_EQ(r.logGain, 0);
}

TEST(PoseUpdate, OfAKnownPoseTellsNothing)
{
  RandomStream random{3};
  PoseUpdate update;
  (void)draw(random, 4, Matrix3::Zero(), update);
  const auto r = update.solve(Matrix3::Zero());
  EXPECT_TRUE(r.shift.isZero());
  EXPECT_TRUE(r.root.isZero());
  EXPECT_EQ(r.logGain, 0);
}
}  // namespace slamot::filters::rbpf
