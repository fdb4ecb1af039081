#include <gtest/gtest.h>
#include <slamot/math/gaussian.h>
#include <slamot/math/intersection.h>
#include <slamot/math/random.h>

#include <limits>

#include "Dense.h"

namespace slamot::math
{
namespace
{
using Eigen::VectorXd;

Dense drawCovariance(RandomStream& random, int n)
{
  Dense A = draw(random, n, n + 2);
  for (int i = 0; i < n; ++i) A.row(i) *= std::exp(0.5 * random.normal());
  return A * A.transpose() / double(n);
}

// An estimate and what it is told, with nothing special about them.
struct Case
{
  Dense P, H, B, independent, E;
  VectorXd nu;

  explicit Case(RandomStream& random)
  {
    const int n = 3 + static_cast<int>(random.uniform(0, 8));
    const int m = 1 + static_cast<int>(random.uniform(0, std::min(n, kMaxBlock)));
    P = drawCovariance(random, n);
    H = draw(random, m, n);
    independent = draw(random, m, 2);
    independent = independent * independent.transpose();
    B = std::exp(random.normal()) * drawCovariance(random, m) + independent;
    E = identity(n).topRows(2 + static_cast<int>(random.uniform(0, n - 1)));
    nu = draw(random, m, 1);
  }

  [[nodiscard]] Dense W() const { return P * H.transpose(); }
  [[nodiscard]] IntersectionCriterion criterion() const
  {
    return {(E * P * E.transpose()).trace(), W().transpose() * E.transpose() * E * W()};
  }
  [[nodiscard]] IntersectionUpdate fuse(Intersection rule, std::optional<double> omega = {}) const
  {
    return intersect(rule, H * W(), nu, B, independent, criterion(), omega);
  }
  [[nodiscard]] Dense cov(const IntersectionUpdate& u) const
  {
    return u.scale * (P - W() * Dense(u.reduction) * W().transpose());
  }
  [[nodiscard]] Dense shift(const IntersectionUpdate& u) const { return W() * Dense(u.gain); }
  [[nodiscard]] double score(const IntersectionUpdate& u) const
  {
    return (E * cov(u) * E.transpose()).trace();
  }
};

constexpr Intersection kRules[] = {Intersection::kCovariance, Intersection::kSplit,
                                   Intersection::kInverse};

// The new mean (minus the old) and covariance in information form, straight from the definitions,
// in long double: inverses lose digits.
void direct(const Case& c, Intersection rule, double w, Dense& shift, Dense& cov)
{
  using Wide = DenseOf<long double>;
  const auto wide = [](const auto& M) { return Wide(M.template cast<long double>()); };
  const auto narrow = [](const Wide& M) { return Dense(M.cast<double>()); };
  const Wide P = wide(c.P), H = wide(c.H), B = wide(c.B), own = wide(c.independent),
             nu = wide(c.nu);
  if (rule != Intersection::kInverse)
  {
    const Wide info = rule == Intersection::kCovariance ? (1 - w) * B.inverse()
                                                        : ((B - own) / (1 - w) + own).inverse();
    const Wide fused = (w * P.inverse() + H.transpose() * info * H).inverse();
    cov = narrow(fused);
    shift = narrow(fused * H.transpose() * info * nu);
    return;
  }
  const Wide W = P * H.transpose(), A = H * W, Ai = A.inverse(), Bi = B.inverse();
  const Wide Si = ((1 - w) * A + w * B).inverse();
  const Wide fused = (Ai + Bi - Si).inverse();
  shift = narrow(W * Ai * fused * (Bi - w * Si) * nu);
  cov = narrow(P - W * Ai * (A - fused) * Ai * W.transpose());
}
}  // namespace

TEST(Intersection, EqualsTheInformationForm)
{
  RandomStream random{1};
  for (int i = 0; i < 1000; ++i)
  {
    const Case c(random);
    const double w = random.uniform(0.02, 0.98);
    for (const Intersection rule : kRules)
    {
      Dense shift, cov;
      direct(c, rule, w, shift, cov);
      const IntersectionUpdate u = c.fuse(rule, w);
      EXPECT_TRUE(u.pays);
      EXPECT_EQ(u.omega, w);
      EXPECT_LT(error(c.cov(u), cov), 1e-10) << "case " << i << " rule " << int(rule);
      EXPECT_LT(error(c.shift(u), shift), 1e-10) << "case " << i << " rule " << int(rule);
    }
  }
}

TEST(Intersection, TakesTheBestWeight)
{
  RandomStream random{2};
  int paying = 0;
  for (int i = 0; i < 300; ++i)
  {
    const Case c(random);
    for (const Intersection rule : kRules)
    {
      const IntersectionUpdate u = c.fuse(rule);
      const double best = c.score(u);
      EXPECT_LE(best, c.criterion().trace * (1 + 1e-12));
      paying += u.pays;
      for (double w = 0.005; w < 1; w += 0.005)
        ASSERT_LE(best, c.score(c.fuse(rule, w)) * (1 + 1e-9))
            << "case " << i << " rule " << int(rule) << " omega " << w << ", not " << u.omega;
    }
  }
  EXPECT_GT(paying, 400);
  EXPECT_LT(paying, 900);
}

TEST(Intersection, CriterionIsConvexInTheWeight)
{
  RandomStream random{3};
  for (int i = 0; i < 100; ++i)
  {
    const Case c(random);
    for (const Intersection rule : kRules)
      for (double w = 0.02; w < 0.97; w += 0.01)
      {
        const double a = c.score(c.fuse(rule, w)), b = c.score(c.fuse(rule, w + 0.01)),
                     d = c.score(c.fuse(rule, w + 0.02));
        EXPECT_LE(2 * b, (a + d) * (1 + 1e-9)) << "case " << i << " rule " << int(rule);
      }
  }
}

TEST(Intersection, EqualCovariancesWeighHalf)
{
  RandomStream random{4};
  Case c(random);
  const int m = std::min<int>(c.P.rows(), kMaxBlock);
  c.B = c.P = c.P.topLeftCorner(m, m).eval();
  c.H = c.E = identity(m);
  c.nu = VectorXd::Ones(m);
  const IntersectionUpdate ci = c.fuse(Intersection::kCovariance);
  EXPECT_TRUE(ci.pays);
  EXPECT_EQ(ci.omega, 0.5);
  EXPECT_LT(error(c.cov(ci), c.P), 1e-12);
  EXPECT_LT(error(c.shift(ci), 0.5 * c.nu), 1e-12);
  c.independent = zeros(m, m);
  EXPECT_EQ(c.fuse(Intersection::kSplit).omega, 0.5);
  EXPECT_EQ(c.fuse(Intersection::kInverse).omega, 0.5);
  const PaperBlock paper = paperBlock(c.P, c.nu, c.B);
  EXPECT_EQ(paper.omega, 0.5);
  EXPECT_LT(error(paper.cov, c.P), 1e-12);
}

TEST(Intersection, ChangesNothingWhereItDoesNotPay)
{
  RandomStream random{5};
  for (int i = 0; i < 100; ++i)
  {
    Case c(random);
    c.B *= 1e4;  // vague
    c.independent *= 0;
    for (const Intersection rule : {Intersection::kCovariance, Intersection::kSplit})
    {
      // The criterion's slope at omega = 1, where covariance intersection begins to pay.
      const auto k = c.criterion();
      const bool pays = (c.B.inverse() * Dense(k.gram)).trace() > k.trace;
      const IntersectionUpdate u = c.fuse(rule);
      EXPECT_EQ(u.pays, pays);
      if (pays) continue;
      EXPECT_EQ(u.omega, 1);
      EXPECT_EQ(u.scale, 1);
      EXPECT_EQ(u.gain, VectorXd::Zero(c.nu.size()));
      EXPECT_EQ(u.reduction, zeros(c.nu.size(), c.nu.size()));
    }
    EXPECT_FALSE(c.fuse(Intersection::kCovariance, 1.0).pays);
  }
}

TEST(Intersection, LeavesAProperCovariance)
{
  RandomStream random{6};
  for (int i = 0; i < 300; ++i)
  {
    Case c(random);
    if (i % 3 == 0) c.P.row(0).setZero(), c.P.col(0).setZero();  // something known exactly
    if (i % 3 == 1) c.B *= 1e-6, c.independent *= 1e-6;          // something told almost exactly
    for (const Intersection rule : kRules)
      for (const double w : {0.0, 1e-4, 0.3, 0.9999})
      {
        const auto u = w > 0 ? c.fuse(rule, w) : c.fuse(rule);
        EXPECT_EQ(asymmetry(u.reduction), 0);
        EXPECT_GE(smallestEigenvalue(c.cov(u)), -1e-11 * c.P.trace() * u.scale)
            << "case " << i << " rule " << int(rule) << " omega " << w;
        if (rule != Intersection::kInverse)
        {
          EXPECT_GE(smallestEigenvalue(u.reduction), -1e-10 * u.reduction.trace());
        }
      }
  }
}

TEST(Intersection, DoesNotCareForTheOrderOfRows)
{
  RandomStream random{7};
  for (int i = 0; i < 100; ++i)
  {
    const Case c(random);
    Case turned = c;
    turned.H = c.H.colwise().reverse();
    turned.nu = c.nu.reverse();
    turned.B = c.B.reverse();
    turned.independent = c.independent.reverse();
    for (const Intersection rule : kRules)
    {
      const auto a = c.fuse(rule), b = turned.fuse(rule);
      EXPECT_NEAR(a.omega, b.omega, 1e-5);
      const auto fixed = c.fuse(rule, 0.4), fixedTurned = turned.fuse(rule, 0.4);
      EXPECT_LT(error(c.cov(fixed), turned.cov(fixedTurned)), 1e-9);
      EXPECT_LT(error(fixed.gain, fixedTurned.gain.reverse()), 1e-9);
    }
  }
}

TEST(Intersection, SplitTakesIndependentNoiseAsAKalmanFilter)
{
  RandomStream random{8};
  for (int i = 0; i < 100; ++i)
  {
    Case c(random);
    c.independent = c.B;
    const auto u = c.fuse(Intersection::kSplit);
    const Dense K = c.W() * (c.H * c.W() + c.B).inverse();
    EXPECT_LT(error(c.cov(u), c.P - K * c.W().transpose()), 1e-6);
    EXPECT_LT(error(c.shift(u), K * Dense(c.nu)), 1e-6);
  }
}

TEST(Intersection, RefusesWhatIsNoCovariance)
{
  RandomStream random{9};
  const auto refused = [](const Case& c, Intersection rule, std::optional<double> omega = {})
  { EXPECT_THROW((void)c.fuse(rule, omega), std::domain_error) << int(rule); };
  for (const Intersection rule : kRules)
  {
    const Case good(random);
    (void)good.fuse(rule);
    Case c = good;
    c.B(0, 0) = std::numeric_limits<double>::quiet_NaN();
    refused(c, rule);
    c = good;
    c.B *= -1;
    refused(c, rule);
    c = good;
    c.nu[0] = std::numeric_limits<double>::infinity();
    refused(c, rule);
    c = good;
    c.P *= -1;
    refused(c, rule);
    c = good;
    c.nu = VectorXd::Zero(9);
    refused(c, rule);
    for (const double omega : {0.0, -0.5, 1.5, std::numeric_limits<double>::quiet_NaN()})
      refused(good, rule, omega);
  }
  Case c(random);
  c.independent = 2.0 * c.B;
  refused(c, Intersection::kSplit);
}

TEST(PaperBlock, EqualsItsEquationsAndTakesTheBestNorm)
{
  RandomStream random{10};
  const auto norm = [](const Dense& C) { return -smallestEigenvalue(-1.0 * C); };
  for (int i = 0; i < 100; ++i)
  {
    const int m = 2 + i % 5;
    const Dense A = drawCovariance(random, m), B = drawCovariance(random, m);
    const Dense a = draw(random, m, 1), b = draw(random, m, 1);
    const VectorXd nu = b - a;
    const double w = random.uniform(0.01, 0.99);
    const PaperBlock fixed = paperBlock(A, nu, B, w), best = paperBlock(A, nu, B);
    const Dense Ai = A.inverse(), Bi = B.inverse(), C = (w * Ai + (1 - w) * Bi).inverse();
    EXPECT_LT(error(fixed.cov, C), 1e-9);
    EXPECT_LT(error(fixed.crossFactor, w * C * Ai), 1e-9);
    EXPECT_LT(error(a + Dense(fixed.shift), C * (w * Ai * a + (1 - w) * Bi * b)), 1e-8);
    for (double grid = 0.01; grid < 1; grid += 0.01)
      EXPECT_LE(norm(best.cov), norm(paperBlock(A, nu, B, grid).cov) * (1 + 1e-6)) << i;
    EXPECT_LE(norm(best.cov), std::min(norm(A), norm(B)) * (1 + 1e-9));
  }
  EXPECT_EQ(paperBlock(identity(2), VectorXd::Ones(2), 9.0 * identity(2)).omega, 1);
}
}  // namespace slamot::math
