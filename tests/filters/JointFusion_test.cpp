#include "rbpf/JointFusion.h"

#include <gtest/gtest.h>
#include <slamot/math/gaussian.h>
#include <slamot/math/random.h>

#include <Eigen/Eigenvalues>
#include <limits>

namespace slamot::filters::rbpf
{
namespace
{
using core::FusionRule;
using Eigen::MatrixXd;

MatrixXd randomCovariance(math::RandomStream& random, Eigen::Index n, double size)
{
  MatrixXd A(n, n);
  for (double& v : A.reshaped()) v = size * random.normal();
  return A * A.transpose() + 0.01 * size * size * MatrixXd::Identity(n, n);
}

/// Joint moments with common errors in them, and what a team mate tells of them.
struct Case
{
  core::RobotAndTarget own;
  CommonErrors common;
  MatrixXd particles;  // covariance of the particles' means
  core::Evidence evidence;

  explicit Case(std::uint64_t seed, bool withPlace)
  {
    math::RandomStream random{seed};
    const Eigen::Index k = seed % 2 == 0 ? 4 : 6, n = 3 + k, first = withPlace ? 2 : 0;
    common.frame = randomCovariance(random, 3, 0.3);
    common.lever.resize(k, 3);
    for (double& v : common.lever.reshaped()) v = random.normal();
    common.target = randomCovariance(random, k, 0.1);
    particles = randomCovariance(random, n, 0.2);
    MatrixXd rigid(n, 3);
    rigid << Matrix3::Identity(), common.lever;
    own.target = 0;
    own.mean = 5 * Eigen::VectorXd::Ones(n);
    own.cov = particles + rigid * common.frame * rigid.transpose();
    own.cov.bottomRightCorner(k, k) += common.target;
    evidence.target = 0;
    evidence.H = MatrixXd::Zero(first + k, n);
    evidence.H.topLeftCorner(first, first).setIdentity();
    evidence.H.bottomRightCorner(k, k).setIdentity();
    evidence.cov = randomCovariance(random, first + k, 0.3);
    evidence.independent = 0.3 * evidence.cov;
    evidence.innovation = 0.2 * Eigen::VectorXd::Ones(first + k);
  }

  /// Of robot and target, after the fusion is carried out on particles and common errors.
  [[nodiscard]] MatrixXd covAfter(const JointFusion& f) const
  {
    const Eigen::Index n = own.mean.size();
    const MatrixXd keep = MatrixXd::Identity(n, n) - f.gain;
    MatrixXd rigid(n, 3);
    rigid << Matrix3::Identity(), common.lever;
    MatrixXd out = keep * particles * keep.transpose() + rigid * f.frame * rigid.transpose();
    out.bottomRightCorner(n - 3, n - 3) += f.target;
    return out;
  }
};
}  // namespace

// With e's correlation to x in [-1, 1] unknown: P+⁻¹ = w P⁻¹ + (1-w) Hᵀ B⁻¹ H, and no less.
TEST(JointFusion, IsAtLeastCovarianceIntersection)
{
  for (std::uint64_t seed = 1; seed <= 40; ++seed)
  {
    const Case c(seed, seed % 3 == 0);
    const double omega = 0.3 + 0.015 * static_cast<double>(seed);
    const JointFusion f = fuseJoint(c.own, c.common, c.evidence, {FusionRule::kCi, omega});
    ASSERT_TRUE(f.pays);
    const MatrixXd H = c.evidence.H, B = c.evidence.cov;
    const MatrixXd exact =
        (omega * c.own.cov.inverse() + (1 - omega) * H.transpose() * B.inverse() * H).inverse();
    const Eigen::VectorXd shift =
        (1 - omega) * exact * H.transpose() * B.inverse() * c.evidence.innovation;
    EXPECT_LT((f.shift - shift).norm(), 1e-9 * (1 + shift.norm())) << "seed " << seed;
    const MatrixXd excess = c.covAfter(f) - exact;
    EXPECT_GT(math::smallestEigenvalue(excess), -1e-9) << "seed " << seed;
  }
}

TEST(JointFusion, AddsNothingWhereNothingWasCorrelated)
{
  for (const FusionRule rule : {FusionRule::kCi, FusionRule::kSplitCi, FusionRule::kIci})
  {
    Case c(2, false);
    MatrixXd rigid(7, 3);
    rigid << Matrix3::Identity(), c.common.lever;
    c.common.target.setZero();  // all error is the frame's
    c.own.cov = rigid * c.common.frame * rigid.transpose();
    c.evidence.H = MatrixXd::Zero(2, 7);
    c.evidence.H(0, 0) = c.evidence.H(1, 1) = 1;
    c.evidence.cov = 0.001 * MatrixXd::Identity(2, 2);
    c.evidence.independent = 0.5 * c.evidence.cov;
    c.evidence.innovation = Vector2(0.1, -0.2);
    const JointFusion f = fuseJoint(c.own, c.common, c.evidence, {rule, {}});
    ASSERT_TRUE(f.pays);
    const MatrixXd moved = rigid * f.frame * rigid.transpose();
    EXPECT_LT(f.target.norm(), 1e-9);
    EXPECT_LT(moved.topLeftCorner(2, 2).trace(), c.own.cov.topLeftCorner(2, 2).trace());
  }
}

TEST(JointFusion, ByEveryRuleLeavesCovariancesPositive)
{
  for (const FusionRule rule :
       {FusionRule::kCi, FusionRule::kSplitCi, FusionRule::kIci, FusionRule::kPaper})
    for (std::uint64_t seed = 1; seed <= 20; ++seed)
    {
      const Case c(seed, seed % 2 == 0);
      const JointFusion f = fuseJoint(c.own, c.common, c.evidence, {rule, {}});
      if (!f.pays) continue;
      EXPECT_GE(math::smallestEigenvalue(f.frame), -1e-12);
      EXPECT_GE(math::smallestEigenvalue(f.target), -1e-12);
      if (rule == FusionRule::kPaper) continue;
      const auto criterion = [](const MatrixXd& P)
      { return P.diagonal().head(2).sum() + 25 * P(2, 2) + P.diagonal().segment(3, 2).sum(); };
      EXPECT_LT(criterion(c.covAfter(f)), criterion(c.own.cov)) << "seed " << seed;
    }
}

TEST(JointFusion, DoesNotPayWhereLittleIsTold)
{
  Case c(1, true);
  c.evidence.cov *= 1e14;
  EXPECT_FALSE(fuseJoint(c.own, c.common, c.evidence, {FusionRule::kCi, {}}).pays);
}

TEST(JointFusion, RefusesWhatIsNoEvidence)
{
  const core::FusionOptions options{FusionRule::kCi, {}};
  Case wrongSize(1, true);
  wrongSize.evidence.H.conservativeResize(8, 8);
  EXPECT_THROW((void)fuseJoint(wrongSize.own, wrongSize.common, wrongSize.evidence, options),
               std::domain_error);
  Case notFinite(1, true);
  notFinite.evidence.innovation[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)fuseJoint(notFinite.own, notFinite.common, notFinite.evidence, options),
               std::domain_error);
  Case indefinite(1, true);
  indefinite.evidence.cov(0, 0) = -1;
  EXPECT_THROW((void)fuseJoint(indefinite.own, indefinite.common, indefinite.evidence, options),
               std::domain_error);
}
}  // namespace slamot::filters::rbpf
