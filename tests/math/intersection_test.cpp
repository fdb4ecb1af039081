#include <gtest/gtest.h>
#include <slamot/math/gaussian.h>
#include <slamot/math/intersection.h>
#include <slamot/math/random.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <limits>

namespace slamot::math
{
namespace
{
using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd drawMatrix(RandomStream& random, int rows, int cols)
{
  MatrixXd A(rows, cols);
  for (double& a : A.reshaped()) a = random.normal();
  return A;
}

MatrixXd drawCovariance(RandomStream& random, int n)
{
  const MatrixXd A = drawMatrix(random, n, n + 2);
  const VectorXd scale = (0.5 * drawMatrix(random, n, 1)).array().exp().matrix();
  return scale.asDiagonal() * (A * A.transpose() / n) * scale.asDiagonal();
}

// An estimate and what it is told, with nothing special about them.
struct Case
{
  MatrixXd P, H, B, independent, E;
  VectorXd nu;

  explicit Case(RandomStream& random)
  {
    const int n = 3 + static_cast<int>(random.uniform(0, 8));
    const int m = 1 + static_cast<int>(random.uniform(0, std::min(n, kMaxBlock)));
    P = drawCovariance(random, n);
    H = drawMatrix(random, m, n);
    independent = drawMatrix(random, m, 2);
    independent = (independent * independent.transpose()).eval();
    B = std::exp(random.normal()) * drawCovariance(random, m) + independent;
    E = MatrixXd::Identity(n, n).topRows(2 + static_cast<int>(random.uniform(0, n - 1)));
    nu = drawMatrix(random, m, 1);
  }

  [[nodiscard]] MatrixXd W() const { return P * H.transpose(); }
  [[nodiscard]] IntersectionCriterion criterion() const
  {
    return {(E * P * E.transpose()).trace(), W().transpose() * E.transpose() * E * W()};
  }
  [[nodiscard]] IntersectionUpdate fuse(Intersection rule, std::optional<double> omega = {}) const
  {
    return intersect(rule, H * W(), nu, B, independent, criterion(), omega);
  }
  [[nodiscard]] MatrixXd cov(const IntersectionUpdate& u) const
  {
    return u.scale * (P - W() * u.reduction * W().transpose());
  }
  [[nodiscard]] double score(const IntersectionUpdate& u) const
  {
    return (E * cov(u) * E.transpose()).trace();
  }
};

constexpr Intersection kRules[] = {Intersection::kCovariance, Intersection::kSplit,
                                   Intersection::kInverse};

double error(const MatrixXd& a, const MatrixXd& b)
{
  return (a - b).cwiseAbs().maxCoeff() / (1 + b.cwiseAbs().maxCoeff());
}

// The new mean (minus the old) and covariance in information form, straight from the definitions,
// in long double: inverses lose digits.
void direct(const Case& c, Intersection rule, double w, VectorXd& shift, MatrixXd& cov)
{
  using Wide = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
  const auto wide = [](const MatrixXd& M) { return Wide(M.cast<long double>()); };
  const Wide P = wide(c.P), H = wide(c.H), B = wide(c.B), own = wide(c.independent),
             nu = wide(c.nu);
  const long double v = 1 - static_cast<long double>(w);
  if (rule != Intersection::kInverse)
  {
    const Wide info = rule == Intersection::kCovariance ? Wide(v * B.inverse())
                                                        : Wide(((B - own) / v + own).inverse());
    const Wide fused = (w * P.inverse() + H.transpose() * info * H).inverse();
    cov = fused.cast<double>();
    shift = (fused * H.transpose() * info * nu).cast<double>();
    return;
  }
  const Wide W = P * H.transpose(), A = H * W, Ai = A.inverse(), Bi = B.inverse();
  const Wide Si = (v * A + w * B).inverse();
  const Wide fused = (Ai + Bi - Si).inverse();
  shift = (W * Ai * fused * (Bi - w * Si) * nu).cast<double>();
  cov = (P - W * Ai * (A - fused) * Ai * W.transpose()).cast<double>();
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
      VectorXd shift;
      MatrixXd cov;
      direct(c, rule, w, shift, cov);
      const IntersectionUpdate u = c.fuse(rule, w);
      EXPECT_TRUE(u.pays);
      EXPECT_EQ(u.omega, w);
      EXPECT_LT(error(c.cov(u), cov), 1e-10) << "case " << i << " rule " << int(rule);
      EXPECT_LT(error(c.W() * u.gain, shift), 1e-10) << "case " << i << " rule " << int(rule);
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
  c.H = MatrixXd::Identity(c.P.rows(), c.P.rows()).topRows(std::min<int>(c.P.rows(), kMaxBlock));
  c.P = c.P.topLeftCorner(c.H.rows(), c.H.rows()).eval();
  c.H = c.E = MatrixXd::Identity(c.P.rows(), c.P.rows());
  c.B = c.P;
  c.nu = VectorXd::Ones(c.P.rows());
  const IntersectionUpdate ci = c.fuse(Intersection::kCovariance);
  EXPECT_TRUE(ci.pays);
  EXPECT_EQ(ci.omega, 0.5);
  EXPECT_LT(error(c.cov(ci), c.P), 1e-12);
  EXPECT_LT(error(c.W() * ci.gain, 0.5 * c.nu), 1e-12);
  c.independent = 0 * c.B;
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
      const bool pays = (c.B.inverse() * k.gram).trace() > k.trace;
      const IntersectionUpdate u = c.fuse(rule);
      EXPECT_EQ(u.pays, pays);
      if (pays) continue;
      EXPECT_EQ(u.omega, 1);
      EXPECT_EQ(u.scale, 1);
      EXPECT_EQ(u.gain, VectorXd::Zero(c.nu.size()));
      EXPECT_EQ(u.reduction, MatrixXd::Zero(c.nu.size(), c.nu.size()));
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
    const MatrixXd K = c.W() * (c.H * c.W() + c.B).inverse();
    EXPECT_LT(error(c.cov(u), c.P - K * c.W().transpose()), 1e-6);
    EXPECT_LT(error(c.W() * u.gain, K * c.nu), 1e-6);
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
  c.independent = 2 * c.B;
  refused(c, Intersection::kSplit);
}

TEST(PaperBlock, EqualsItsEquationsAndTakesTheBestNorm)
{
  RandomStream random{10};
  const auto norm = [](const MatrixXd& C)
  { return Eigen::SelfAdjointEigenSolver<MatrixXd>(C).eigenvalues().maxCoeff(); };
  for (int i = 0; i < 100; ++i)
  {
    const int m = 2 + i % 5;
    const MatrixXd A = drawCovariance(random, m), B = drawCovariance(random, m);
    const VectorXd a = drawMatrix(random, m, 1), b = drawMatrix(random, m, 1);
    const double w = random.uniform(0.01, 0.99);
    const PaperBlock fixed = paperBlock(A, b - a, B, w), best = paperBlock(A, b - a, B);
    const MatrixXd C = (w * A.inverse() + (1 - w) * B.inverse()).inverse();
    EXPECT_LT(error(fixed.cov, C), 1e-9);
    EXPECT_LT(error(fixed.crossFactor, w * C * A.inverse()), 1e-9);
    EXPECT_LT(error(a + fixed.shift, C * (w * A.inverse() * a + (1 - w) * B.inverse() * b)), 1e-8);
    for (double grid = 0.01; grid < 1; grid += 0.01)
      EXPECT_LE(norm(best.cov), norm(paperBlock(A, b - a, B, grid).cov) * (1 + 1e-6)) << i;
    EXPECT_LE(norm(best.cov), std::min(norm(A), norm(B)) * (1 + 1e-9));
  }
  EXPECT_EQ(
      paperBlock(MatrixXd::Identity(2, 2), VectorXd::Ones(2), 9 * MatrixXd::Identity(2, 2)).omega,
      1);
}
}  // namespace slamot::math
