#include <slamot/math/eigensystem.h>
#include <slamot/math/gaussian.h>
#include <slamot/math/intersection.h>

#include <Eigen/Cholesky>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace slamot::math
{
namespace
{
using ConstMatrix = Eigen::Ref<const Eigen::MatrixXd>;
using ConstVector = Eigen::Ref<const Eigen::VectorXd>;

constexpr double kFlat = 1e-10;  // a criterion that differs by less, relatively, is equal
// The range of omega searched, as logits: to 2e-9 of 1, but not below 1e-4, where P+ would be the
// difference of large numbers.
constexpr double kLowestLogit = -9.2, kHighestLogit = 20;
constexpr double kRounding = 1e-9;  // a negative eigenvalue this small, relatively, is zero

/// omega and 1 - omega, each without loss where the other is near 1.
struct Weights
{
  double own, other;

  static Weights ofLogit(double u) { return {1 / (1 + std::exp(-u)), 1 / (1 + std::exp(u))}; }
  static Weights of(double omega) { return {omega, 1 - omega}; }
};

void require(bool ok, const char* what)
{
  if (!ok) throw std::domain_error(what);
}

void checkBlock(const ConstMatrix& M, Eigen::Index m)
{
  require(M.rows() == m && M.cols() == m, "sizes of a block disagree");
  require(M.allFinite(), "a covariance is not finite");
}

void checkOmega(const std::optional<double>& omega)
{
  require(!omega || (*omega > 0 && *omega <= 1), "omega is not in (0, 1]");
}

/// A and B made diagonal together, so that every omega costs a sum: Vᵀ A V = diag(lambda),
/// Vᵀ B V = 1.
struct Pencil
{
  BlockMatrix V;
  BlockVector lambda;

  Pencil(const ConstMatrix& A, const ConstMatrix& B)
  {
    const Eigen::LLT<BlockMatrix> llt(B);
    require(llt.info() == Eigen::Success, "a covariance is not positive definite");
    BlockMatrix whitened = llt.matrixL().solve(BlockMatrix(A));
    whitened = llt.matrixL().solve(BlockMatrix(whitened.transpose()));
    const BlockMatrix symmetric = 0.5 * (whitened + whitened.transpose());
    require(symmetric.allFinite(), "a covariance is badly scaled");
    const auto eigen = eigensystem<Eigen::Dynamic>(symmetric);
    require(eigen.values.allFinite(), "a covariance is badly scaled");
    lambda = eigen.values;
    require(lambda.minCoeff() >= -kRounding * (1 + lambda.maxCoeff()),
            "a covariance is not positive semidefinite");
    lambda = lambda.cwiseMax(0.0);
    V = llt.matrixU().solve(BlockMatrix(eigen.vectors));
  }
};

/// One rule on one block, in the basis of its pencil.
class Rule
{
 public:
  Rule(Intersection rule, const ConstMatrix& A, const ConstMatrix& B,
       const ConstMatrix& independent, const IntersectionCriterion& criterion)
      : rule_(rule), pencil_(A, B), trace_(criterion.trace)
  {
    gram_.noalias() = pencil_.V.transpose() * criterion.gram * pencil_.V;
    if (rule_ == Intersection::kSplit) setIndependent(independent);
  }

  [[nodiscard]] double scale(const Weights& w) const
  {
    return rule_ == Intersection::kInverse ? 1 : 1 / w.own;
  }

  /// tr(E P+ Eᵀ).
  [[nodiscard]] double criterion(const Weights& w) const
  {
    const double gained = rule_ == Intersection::kSplit
                              ? splitReduction(w).cwiseProduct(gram_).sum()
                              : reductions(w).dot(gram_.diagonal());
    return scale(w) * (trace_ - gained);
  }

  void apply(const Weights& w, const ConstVector& innovation, IntersectionUpdate& out) const
  {
    const BlockMatrix& V = pencil_.V;
    const BlockVector nu = V.transpose() * innovation;
    out.omega = w.own;
    out.scale = scale(w);
    BlockMatrix reduction =
        rule_ == Intersection::kSplit ? splitReduction(w) : BlockMatrix(reductions(w).asDiagonal());
    const BlockVector gain = rule_ == Intersection::kInverse
                                 ? BlockVector(inverseGains(w).cwiseProduct(nu))
                                 : BlockVector(reduction * nu);
    out.gain = V * gain;
    reduction = V * reduction * V.transpose();
    out.reduction = 0.5 * (reduction + reduction.transpose());
  }

 private:
  // kCovariance: (A + r B)⁻¹, r = omega / (1 - omega).  kInverse: A⁻¹ (A - A+) A⁻¹, which, like the
  // gain A⁻¹ (a+ - a), is well defined for lambda = 0 too.
  [[nodiscard]] BlockVector reductions(const Weights& w) const
  {
    const auto& lambda = pencil_.lambda.array();
    if (rule_ == Intersection::kInverse)
      return (w.other * (lambda - 1) / (w.own + w.other * lambda.square())).matrix();
    return (w.other / (w.own + w.other * lambda)).matrix();
  }
  [[nodiscard]] BlockVector inverseGains(const Weights& w) const
  {
    const auto& lambda = pencil_.lambda.array();
    return (w.other * lambda / (w.own + w.other * lambda.square())).matrix();
  }

  // (A + r (B - I) + omega I)⁻¹, both sides divided by r + 1 = 1 / (1 - omega).
  [[nodiscard]] BlockMatrix splitReduction(const Weights& w) const
  {
    const Eigen::Index m = pencil_.lambda.size();
    BlockMatrix S = -w.own * w.own * independent_;
    S.diagonal() += w.other * pencil_.lambda + BlockVector::Constant(m, w.own);
    return w.other * S.llt().solve(BlockMatrix::Identity(m, m));
  }

  void setIndependent(const ConstMatrix& independent)
  {
    const BlockMatrix whitened = pencil_.V.transpose() * BlockMatrix(independent) * pencil_.V;
    independent_ = 0.5 * (whitened + whitened.transpose());
    const Eigen::VectorXd values = eigensystem<Eigen::Dynamic>(independent_).values;
    require(values[0] >= -kRounding && values[values.size() - 1] <= 1 + kRounding,
            "the independent part is not one of the covariance");
  }

  Intersection rule_;
  Pencil pencil_;
  double trace_;
  BlockMatrix gram_, independent_;
};

/// The logit of omega where a function, convex in omega, is smallest.
template <class F>
double smallestLogit(const F& f)
{
  std::uintmax_t iterations = 100;
  return boost::math::tools::brent_find_minima(f, kLowestLogit, kHighestLogit, 26, iterations)
      .first;
}
}  // namespace

IntersectionUpdate intersect(Intersection rule, const ConstMatrix& A, const ConstVector& innovation,
                             const ConstMatrix& B, const ConstMatrix& independent,
                             const IntersectionCriterion& criterion, std::optional<double> omega)
{
  const Eigen::Index m = innovation.size();
  require(m >= 1 && m <= kMaxBlock, "a block has 1 to 8 coordinates");
  checkBlock(A, m);
  checkBlock(B, m);
  if (rule == Intersection::kSplit) checkBlock(independent, m);
  checkBlock(criterion.gram, m);
  require(innovation.allFinite() && std::isfinite(criterion.trace), "an innovation is not finite");
  checkOmega(omega);

  const Rule fused(rule, A, B, independent, criterion);
  IntersectionUpdate out;
  out.gain = BlockVector::Zero(m);
  out.reduction = BlockMatrix::Zero(m, m);
  if (omega)
  {
    out.pays = *omega < 1;
    if (out.pays) fused.apply(Weights::of(*omega), innovation, out);
    return out;
  }
  if (!(criterion.trace > 0)) return out;  // nothing is left to be gained
  const auto at = [&fused](double u) { return fused.criterion(Weights::ofLogit(u)); };
  double u = smallestLogit(at);
  const double half = at(0), smallest = std::min({at(u), half, criterion.trace});
  if (half <= smallest * (1 + kFlat)) u = 0;
  out.pays = u == 0 || at(u) < criterion.trace * (1 - kFlat);
  if (out.pays) fused.apply(Weights::ofLogit(u), innovation, out);
  return out;
}

PaperBlock paperBlock(const ConstMatrix& A, const ConstVector& innovation, const ConstMatrix& B,
                      std::optional<double> omega)
{
  const Eigen::Index m = innovation.size();
  require(m >= 1 && m <= kMaxBlock, "a block has 1 to 8 coordinates");
  checkBlock(A, m);
  checkBlock(B, m);
  require(innovation.allFinite(), "an innovation is not finite");
  checkOmega(omega);

  const Pencil pencil(A, B);
  require(pencil.lambda.minCoeff() > 0, "a covariance is not positive definite");
  const BlockMatrix one = BlockMatrix::Identity(m, m);
  const BlockMatrix infoA = BlockMatrix(A).llt().solve(one),
                    infoB = BlockMatrix(B).llt().solve(one);
  const auto norm = [&infoA, &infoB](double w)
  {
    const BlockMatrix info = w * infoA + (1 - w) * infoB;
    return 1 / smallestEigenvalue(info);
  };
  PaperBlock out;
  if (omega)
    out.omega = *omega;
  else
  {
    const double w = boost::math::tools::brent_find_minima(norm, 0.0, 1.0, 30).first;
    out.omega = w;
    for (const double end : {0.0, 1.0, 0.5})  // brent comes near an end, but not to it
      if (norm(end) <= norm(out.omega) * (1 + kFlat)) out.omega = end;
  }
  const BlockMatrix info = out.omega * infoA + (1 - out.omega) * infoB;
  out.cov = info.llt().solve(one);
  out.cov = (0.5 * (out.cov + out.cov.transpose())).eval();
  out.crossFactor = out.omega * out.cov * infoA;
  out.shift = innovation - out.crossFactor * innovation;
  return out;
}
}  // namespace slamot::math
