#include "JointFusion.h"

#include "sighting/intersectionOf.h"

#include <slamot/math/eigensystem.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace slamot::filters::rbpf
{
namespace
{
using Eigen::MatrixXd;
using Eigen::VectorXd;
constexpr int kRobot = core::RobotAndTarget::kRobot;
constexpr int kSteps = 5;           // of weights tried, each twice as near to 1
constexpr double kNothing = 1e-10;  // a criterion that is smaller by less, relatively, is equal

MatrixXd symmetric(const MatrixXd& m)
{
  return 0.5 * (m + m.transpose());
}

/// The fused moments, and the gain that leads there.
struct Fused
{
  bool pays = false;
  double omega = 1;
  VectorXd shift;
  MatrixXd gain, cov;
};

/// What counts of robot and target: places, and the robot's heading times a lever.
VectorXd criterionWeights(Eigen::Index size, double lever)
{
  VectorXd out = VectorXd::Zero(size);
  out.head<kRobot>() << 1, 1, lever * lever;
  if (size > kRobot) out.segment<2>(kRobot).setOnes();
  return out;
}

Fused intersected(const MatrixXd& P, const core::Evidence& e, const core::FusionOptions& options)
{
  const VectorXd counts = criterionWeights(P.rows(), options.headingLever);
  const MatrixXd W = P * e.H.transpose(), A = symmetric(e.H * W);
  const math::IntersectionCriterion criterion{counts.dot(P.diagonal()),
                                              symmetric(W.transpose() * counts.asDiagonal() * W)};
  const math::Intersection rule = intersectionOf(options.rule);
  const auto intersect = [&](const VectorXd& innovation, std::optional<double> omega)
  { return math::intersect(rule, A, innovation, e.cov, e.independent, criterion, omega); };
  const auto update = intersect(e.innovation, options.omega);
  Fused out;
  out.pays = update.pays;
  if (!out.pays) return out;
  out.omega = update.omega;
  out.shift = W * update.gain;
  MatrixXd perInnovation = update.reduction;
  if (rule == math::Intersection::kInverse)  // of which the gain is another
    for (Eigen::Index j = 0; j < W.cols(); ++j)
      perInnovation.col(j) = intersect(VectorXd::Unit(W.cols(), j), update.omega).gain;
  out.gain = W * perInnovation * e.H;
  out.cov = symmetric(update.scale * (P - W * update.reduction * W.transpose()));
  return out;
}

/// First the robot's place, then the target: equations (3)-(15) of the paper, as corrected.
Fused blockByBlock(const MatrixXd& P, const core::Evidence& e, const core::FusionOptions& options)
{
  const Eigen::Index n = P.rows(), rows = e.H.rows();
  const Eigen::Index first = (e.H.leftCols<kRobot>().array() != 0).any() ? 2 : 0;
  if (rows < first || rows - first > n - kRobot)
    throw std::domain_error("the paper's rule wants the target's own coordinates");
  Fused out{true, 0, VectorXd::Zero(n), MatrixXd::Identity(n, n), P};
  const auto fuse = [&](Eigen::Index j, Eigen::Index row, Eigen::Index k)
  {
    const auto block = math::paperBlock(out.cov.block(j, j, k, k), e.innovation.segment(row, k),
                                        e.cov.block(row, row, k, k), options.omega);
    out.shift.segment(j, k) = block.shift;
    MatrixXd T = MatrixXd::Identity(n, n);
    T.block(j, j, k, k) = block.crossFactor;
    out.cov = (T * out.cov * T.transpose()).eval();
    out.cov.block(j, j, k, k) = block.cov;
    out.gain = T * out.gain;
    out.omega = std::max(out.omega, block.omega);
  };
  if (first > 0) fuse(0, 0, first);
  if (rows > first) fuse(kRobot, first, rows - first);
  out.gain = (MatrixXd::Identity(n, n) - out.gain).eval();
  return out;
}

/// A symmetric square root of a positive semidefinite matrix, and its pseudo-inverse.
struct Root
{
  MatrixXd root, inverse;

  explicit Root(const MatrixXd& m)
  {
    const auto eigen = math::eigensystem<Eigen::Dynamic>(m);
    const VectorXd values = eigen.values.cwiseMax(0.0).cwiseSqrt();
    const double least = 1e-7 * values.maxCoeff();
    const VectorXd inverses =
        values.unaryExpr([least](double v) { return v > least ? 1 / v : 0.0; });
    root = eigen.vectors * values.asDiagonal() * eigen.vectors.transpose();
    inverse = eigen.vectors * inverses.asDiagonal() * eigen.vectors.transpose();
  }
};

/// Splits common errors Q into a rigid motion and the target's own, uncorrelated, so that together
/// they are no less than Q.  With a singular value s of the whitened correlation, and its two
/// directions u, w in metres: [s a uu', s uw'; s wu', s/a ww'] is positive semidefinite for all
/// a > 0, and added to Q takes the correlation away; a is what costs the criterion least.
/// Without `whole`, the correlation is dropped and nothing added.
void separate(const MatrixXd& Q, const CommonErrors& common, const VectorXd& counts, bool whole,
              JointFusion& out)
{
  const Eigen::Index n = Q.rows(), k = n - kRobot;
  MatrixXd toOwn = MatrixXd::Identity(n, n), rigid(n, kRobot);
  toOwn.bottomLeftCorner(k, kRobot) = -common.lever;
  rigid << Matrix3::Identity(), common.lever;
  const MatrixXd own = symmetric(toOwn * Q * toOwn.transpose());
  const Root frame(own.topLeftCorner<kRobot, kRobot>());
  out.frame = frame.root * frame.root;
  if (k == 0) return;
  const Root target(own.bottomRightCorner(k, k));
  out.target = target.root * target.root;
  if (!whole) return;
  const MatrixXd correlation = frame.inverse * own.topRightCorner(kRobot, k) * target.inverse;
  const Eigen::JacobiSVD<MatrixXd> svd(correlation, Eigen::ComputeThinU | Eigen::ComputeThinV);
  for (Eigen::Index j = 0; j < svd.singularValues().size(); ++j)
  {
    const double s = std::min(1.0, svd.singularValues()[j]);
    const VectorXd u = frame.root * svd.matrixU().col(j), w = target.root * svd.matrixV().col(j);
    const double ofFrame = counts.dot((rigid * u).cwiseAbs2());
    const double ofTarget = counts.tail(k).dot(w.cwiseAbs2());
    const double a = ofFrame > 0 ? std::sqrt(std::max(ofTarget / ofFrame, 1e-6)) : 1.0;
    out.frame += s * a * u * u.transpose();
    out.target += s / a * w * w.transpose();
  }
}

struct Separated
{
  JointFusion fusion;
  double cost;  ///< the criterion, of all errors after it
};

/// Of the fused covariance, what is common is all that the particles' own differences, carried
/// through the gain, do not account for.
Separated separated(const core::RobotAndTarget& own, const CommonErrors& common, const Fused& fused,
                    const VectorXd& counts, bool whole)
{
  const Eigen::Index n = own.mean.size(), k = n - kRobot;
  const MatrixXd keep = MatrixXd::Identity(n, n) - fused.gain;
  MatrixXd rigid(n, kRobot);
  rigid << Matrix3::Identity(), common.lever;
  const auto together = [&](const Matrix3& frame, const MatrixXd& target)
  {
    MatrixXd out = rigid * frame * rigid.transpose();
    out.bottomRightCorner(k, k) += target;
    return out;
  };
  const MatrixXd ofParticles =
      keep * (own.cov - together(common.frame, common.target)) * keep.transpose();
  Separated out;
  out.fusion.omega = fused.omega;
  out.fusion.shift = fused.shift;
  out.fusion.gain = fused.gain;
  out.fusion.target.setZero(k, k);
  separate(fused.cov - ofParticles, common, counts, whole, out.fusion);
  const MatrixXd after = ofParticles + together(out.fusion.frame, out.fusion.target);
  out.cost = counts.dot(after.diagonal());
  if (!std::isfinite(out.cost) || !out.fusion.shift.allFinite())
    throw std::domain_error("a covariance is badly scaled");
  return out;
}
}  // namespace

JointFusion fuseJoint(const core::RobotAndTarget& own, const CommonErrors& common,
                      const core::Evidence& evidence, const core::FusionOptions& options)
{
  if (evidence.H.cols() != own.mean.size()) throw std::domain_error("it is of other coordinates");
  if (evidence.H.rows() != evidence.innovation.size())
    throw std::domain_error("sizes of a block disagree");
  const bool blocks = options.rule == core::FusionRule::kPaper;
  const Fused fused =
      blocks ? blockByBlock(own.cov, evidence, options) : intersected(own.cov, evidence, options);
  if (!fused.pays) return {};
  const VectorXd counts = criterionWeights(own.mean.size(), options.headingLever);
  Separated best = separated(own, common, fused, counts, !blocks);
  best.fusion.pays = true;
  if (blocks || options.omega) return best.fusion;

  // A smaller step correlates less: the best weight may be nearer to 1.
  core::FusionOptions nearer = options;
  for (double other = 0.5 * (1 - fused.omega), n = 1; n < kSteps; other *= 0.5, ++n)
  {
    nearer.omega = 1 - other;
    const Fused step = intersected(own.cov, evidence, nearer);
    Separated next = step.pays ? separated(own, common, step, counts, true) : best;
    if (!(next.cost < best.cost)) break;
    best = next;
  }
  best.fusion.pays = best.cost < counts.dot(own.cov.diagonal()) * (1 - kNothing);
  return best.fusion;
}
}  // namespace slamot::filters::rbpf
