#include <slamot/scans/PoseGraph.h>

#include <Eigen/LU>
#include <Eigen/SparseCholesky>
#include <algorithm>

namespace slamot::scans
{
namespace
{
using Sparse = Eigen::SparseMatrix<double>;
using Solver = Eigen::SimplicialLDLT<Sparse>;

constexpr double kPhi = 10;  // of dynamic covariance scaling: a chi-square hardly ever exceeded
constexpr int kMostSteps = 15;
constexpr double kStill = 1e-4;  // [m, rad]

struct Residual
{
  Vector3 error;
  Matrix3 byFrom, byTo;  // Jacobians
};

Residual residualOf(const Pose2D& from, const Pose2D& to, const Pose2D& measured)
{
  const Pose2D is = math::between(from, to);
  const Matrix3 Rt = math::poseRotation(from.phi).transpose();
  Residual r;
  r.error = {is.x - measured.x, is.y - measured.y, math::wrapToPi(is.phi - measured.phi)};
  r.byTo = Rt;
  r.byFrom = -Rt;
  r.byFrom(0, 2) = is.y;
  r.byFrom(1, 2) = -is.x;
  return r;
}
}  // namespace

struct PoseGraph::System
{
  Sparse H;  // lower triangle
  Eigen::VectorXd g;
};

void PoseGraph::restore(std::size_t relations, std::vector<Pose2D> poses)
{
  relations_.resize(relations);
  poses_ = std::move(poses);
}

double PoseGraph::chi2(const Relation& r) const
{
  const Vector3 e = residualOf(poses_[r.from], poses_[r.to], r.pose_from_to.mean).error;
  return e.dot(r.pose_from_to.cov.inverse() * e);
}

double PoseGraph::trust(const Relation& r) const
{
  if (!r.doubtful) return 1;
  const double s = std::min(1.0, 2 * kPhi / (kPhi + chi2(r)));
  return s * s;
}

PoseGraph::System PoseGraph::linearise(std::size_t trusted) const
{
  const auto n = static_cast<Eigen::Index>(3 * (poses_.size() - 1));
  System out{Sparse(n, n), Eigen::VectorXd::Zero(n)};
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(relations_.size() * 27);
  // Blocks of the lower triangle; the first pose has no columns.
  const auto add = [&](std::size_t a, std::size_t b, const Matrix3& block)
  {
    if (a == 0 || b == 0 || a < b) return;
    const auto row = static_cast<int>(3 * (a - 1)), column = static_cast<int>(3 * (b - 1));
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        if (row + i >= column + j) entries.emplace_back(row + i, column + j, block(i, j));
  };
  for (std::size_t k = 0; k < relations_.size(); ++k)
  {
    const Relation& m = relations_[k];
    const Residual r = residualOf(poses_[m.from], poses_[m.to], m.pose_from_to.mean);
    const Matrix3 W = (k < trusted ? trust(m) : 1.0) * m.pose_from_to.cov.inverse();
    const std::pair<std::size_t, Matrix3> ends[] = {{m.from, r.byFrom}, {m.to, r.byTo}};
    for (const auto& [a, Ja] : ends)
    {
      if (a > 0)
        out.g.segment<3>(static_cast<Eigen::Index>(3 * (a - 1))) += Ja.transpose() * W * r.error;
      for (const auto& [b, Jb] : ends) add(a, b, Ja.transpose() * W * Jb);
    }
  }
  out.H.setFromTriplets(entries.begin(), entries.end());
  return out;
}

void PoseGraph::optimise(std::size_t trusted)
{
  if (poses_.size() < 2) return;
  Solver solver;
  for (int step = 0; step < kMostSteps; ++step)
  {
    const System system = linearise(trusted);
    if (step == 0) solver.analyzePattern(system.H);
    solver.factorize(system.H);
    if (solver.info() != Eigen::Success) return;
    const Eigen::VectorXd d = solver.solve(system.g);
    if (!d.allFinite()) return;
    for (std::size_t i = 1; i < poses_.size(); ++i)
    {
      const auto at = static_cast<Eigen::Index>(3 * (i - 1));
      Pose2D& p = poses_[i];
      p = {p.x - d[at], p.y - d[at + 1], math::wrapToPi(p.phi - d[at + 2])};
    }
    if (d.cwiseAbs().maxCoeff() < kStill) return;
  }
}

Matrix3 PoseGraph::covariance(std::size_t node) const
{
  if (node == 0) return Matrix3::Zero();
  const System system = linearise(relations_.size());
  const Solver solver(system.H);
  const auto at = static_cast<Eigen::Index>(3 * (node - 1));
  Eigen::MatrixXd unit = Eigen::MatrixXd::Zero(system.H.rows(), 3);
  unit.middleRows<3>(at).setIdentity();
  const Matrix3 cov = Eigen::MatrixXd(solver.solve(unit)).middleRows<3>(at);
  return 0.5 * (cov + cov.transpose());
}
}  // namespace slamot::scans
