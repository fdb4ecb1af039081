#include "sighting/soften.h"

#include <gtest/gtest.h>

#include "sighting/Targets.h"

namespace slamot::filters
{
namespace
{
using models::NoiseLaw;
using Tail = NoiseLaw::Tail;

/// A point with covariance, and where it is measured, x and y, with deviation `std` each and a law.
struct Case
{
  maps::Landmark prior;
  Vector2 measured;
  double std;
  NoiseLaw law;

  [[nodiscard]] Ray ray() const
  {
    Ray z;
    z.varRange = z.varBearing = std * std;
    z.law = &law;
    return z;
  }
  [[nodiscard]] Innovation innovation() const
  {
    Innovation o{};
    o.nuR = measured[0] - prior.x;
    o.nuB = measured[1] - prior.y;
    o.s11 = prior.cxx + std * std;
    o.s12 = prior.cxy;
    o.s22 = prior.cyy + std * std;
    o.det = o.s11 * o.s22 - o.s12 * o.s12;
    o.h11 = o.h22 = 1;
    o.turnB = -1;
    o.factor = 1;
    o.d2 = o.form();
    return o;
  }
};

/// The posterior on a fine grid: density of the measurement, mean and covariance.
struct Posterior
{
  double density = 0;
  Vector2 mean = Vector2::Zero();
  Matrix2 cov = Matrix2::Zero();

  explicit Posterior(const Case& c)
  {
    Matrix2 P;
    P << c.prior.cxx, c.prior.cxy, c.prior.cxy, c.prior.cyy;
    const Matrix2 Pi = P.inverse();
    constexpr double kStep = 0.02, kHalf = 6;
    Matrix2 second = Matrix2::Zero();
    for (double dx = -kHalf; dx <= kHalf; dx += kStep)
      for (double dy = -kHalf; dy <= kHalf; dy += kStep)
      {
        const Vector2 d(dx, dy), w = c.measured - Vector2(c.prior.x + dx, c.prior.y + dy);
        double likelihood = 0;
        for (const auto& g : c.law.components())
        {
          const double var = g.factor * c.std * c.std;
          likelihood += g.weight * std::exp(-0.5 * w.squaredNorm() / var) / (math::kTwoPi * var);
        }
        const double p = likelihood * std::exp(-0.5 * d.dot(Pi * d)) /
                         (math::kTwoPi * std::sqrt(P.determinant())) * kStep * kStep;
        density += p;
        mean += p * d;
        second += p * d * d.transpose();
      }
    mean /= density;
    cov = second / density - mean * mean.transpose();
    mean += Vector2(c.prior.x, c.prior.y);
  }
};

std::vector<Case> cases()
{
  std::vector<Case> out;
  for (const Tail tail : {Tail::kStudent, Tail::kGaussian, Tail::kLaplace})
    for (const double off : {0.0, 0.8, 2.0, 4.0})
      out.push_back({{1, -2, 0.5, 0.2, 0.8, 1, 0},
                     {1 + off, -2 - 0.4 * off},
                     0.3,
                     NoiseLaw({0.3, tail, 3, 2})});
  return out;
}
}  // namespace

TEST(Glint, UpdateHasTheMomentsOfThePosterior)
{
  for (const Case& c : cases())
  {
    const Posterior expected(c);
    Innovation o = c.innovation();
    soften(c.ray(), 1, nullptr, o);
    maps::Landmark m = c.prior;
    correct(m, o);
    SCOPED_TRACE(c.measured[0]);
    EXPECT_NEAR(m.x, expected.mean[0], 2e-3);
    EXPECT_NEAR(m.y, expected.mean[1], 2e-3);
    EXPECT_NEAR(m.cxx, expected.cov(0, 0), 2e-3);
    EXPECT_NEAR(m.cxy, expected.cov(0, 1), 2e-3);
    EXPECT_NEAR(m.cyy, expected.cov(1, 1), 2e-3);
    EXPECT_NEAR(std::exp(logDensity(o, true)), expected.density, 1e-3 * expected.density + 1e-7);
  }
}

TEST(Glint, TargetsAreUpdatedAsLandmarksAre)
{
  for (const Case& c : cases())
  {
    Innovation o = c.innovation();
    soften(c.ray(), 1, nullptr, o);
    maps::Landmark m = c.prior;
    correct(m, o);
    models::ConstantVelocityTarget::State t;
    t.x << c.prior.x, c.prior.y, 0.5, 0;
    t.P.topLeftCorner<2, 2>() << c.prior.cxx, c.prior.cxy, c.prior.cxy, c.prior.cyy;
    t.P.diagonal().tail<2>().setOnes();
    const models::ConstantVelocityTarget motion({1, 0, 0.1});
    correctTarget(motion, t, Eye(Pose2D()), c.ray(), o);
    EXPECT_NEAR(t.x[0], m.x, 1e-12);
    EXPECT_NEAR(t.x[1], m.y, 1e-12);
    EXPECT_NEAR(t.P(0, 0), m.cxx, 1e-12);
    EXPECT_NEAR(t.P(0, 1), m.cxy, 1e-12);
    EXPECT_NEAR(t.P(1, 1), m.cyy, 1e-12);
  }
}

TEST(Glint, LawWithoutOutliersChangesNothing)
{
  Case c{{1, -2, 0.5, 0.2, 0.8, 1, 0}, {2, -1}, 0.3, NoiseLaw({0, Tail::kStudent, 3, 2})};
  const Innovation before = c.innovation();
  Innovation o = before;
  soften(c.ray(), 1, nullptr, o);
  EXPECT_NEAR(o.s11, before.s11, 1e-14);
  EXPECT_NEAR(o.s12, before.s12, 1e-14);
  EXPECT_NEAR(o.s22, before.s22, 1e-14);
  EXPECT_NEAR(o.d2, before.d2, 1e-12);
  EXPECT_NEAR(o.e11 + o.e22, 0, 1e-14);
  EXPECT_EQ(o.factor, 1);
}

// A pose's doubt, which is not in S, explains a large innovation: the sighting then keeps its
// weight.
TEST(Glint, PosesDoubtIsNoGlint)
{
  const Case c{{0, 0, 0.01, 0, 0.01, 1, 0}, {1.5, 0}, 0.1, NoiseLaw({0.1, Tail::kStudent, 3, 2})};
  Innovation sure = c.innovation(), doubtful = sure;
  soften(c.ray(), 1, nullptr, sure);
  const Matrix3 poseCov = Vector3(4, 4, 0.01).asDiagonal();
  soften(c.ray(), 1, &poseCov, doubtful);
  EXPECT_GT(sure.factor, 20);
  EXPECT_LT(doubtful.factor, 1.3);
}

TEST(Glint, WhatIsSeenOnceMayBeAnOutlier)
{
  const NoiseLaw law({0.3, Tail::kGaussian, 5, 2});
  Ray z = Ray::of(3, 0.2, 0.1, 0.02);
  const Matrix2 normal = invert(Eye(Pose2D()), z).cov;
  z.law = &law;
  EXPECT_LT((invert(Eye(Pose2D()), z).cov - (0.7 + 0.3 * 25) * normal).norm(), 1e-12);
}

TEST(Glint, BearingAloneIsOneDimensional)
{
  const NoiseLaw law({0.3, Tail::kGaussian, 5, 2});
  Ray z = Ray::ofBearing(0.1, 0.02);
  z.law = &law;
  Innovation o;
  ASSERT_TRUE(innovate(Eye(Pose2D()), z, 10, 0, 0.04, 0, 0.04, o));
  const double nu = o.nuB, s = o.s22, more = 24 * 0.02 * 0.02;
  soften(z, 1, nullptr, o);
  const auto density = [&](double var)
  { return std::exp(-0.5 * nu * nu / var) / std::sqrt(math::kTwoPi * var); };
  EXPECT_NEAR(std::exp(logDensity(o, false)), 0.7 * density(s) + 0.3 * density(s + more), 1e-9);
  EXPECT_NEAR(o.s11, 1, 1e-12);
}

TEST(Glint, NothingBeyondReachPassesTheGate)
{
  for (const Tail tail : {Tail::kStudent, Tail::kGaussian, Tail::kLaplace})
    for (const double gate : {5.0, 9.2, 23.0})
    {
      const NoiseLaw law({0.2, tail, 3, 2});
      const double reach = std::sqrt(gate * reachOf(law, gate));
      for (double prior = 1e-6; prior < 100; prior *= 3)
        for (double d = 1.03 * reach; d < 300 * reach; d *= 1.1)
        {
          Case c{{0, 0, prior, 0, prior, 1, 0}, {d * std::sqrt(1 + prior), 0}, 1, law};
          Innovation o = c.innovation();
          soften(c.ray(), 1, nullptr, o);
          EXPECT_GT(o.d2, gate) << "prior " << prior << ", distance " << d;
        }
    }
}
}  // namespace slamot::filters
