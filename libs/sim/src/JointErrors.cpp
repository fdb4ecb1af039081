#include "JointErrors.h"

#include <Eigen/Cholesky>

#include <algorithm>

namespace slamot::sim
{
void JointErrors::reserve(int size)
{
  if (size <= P_.rows()) return;
  const auto larger = std::max<Eigen::Index>(size, 3 * P_.rows() / 2);
  P_.conservativeResize(larger, larger);
  error_.conservativeResize(larger);
}

JointErrors::Matrix JointErrors::columns(int at, int count) const
{
  Matrix out(size_, count);
  out.topRows(at) = P_.block(at, 0, count, at).transpose();
  out.middleRows(at, count) = block(at, count);
  const int below = size_ - at - count;
  out.bottomRows(below) = P_.block(at + count, at, below, count);
  return out;
}

JointErrors::Matrix JointErrors::block(int at, int count) const
{
  return P_.block(at, at, count, count).selfadjointView<Eigen::Lower>();
}

int JointErrors::add(const ConstMatrix& covariance, const ConstVector& error)
{
  const int at = size_, n = static_cast<int>(covariance.rows());
  reserve(at + n);
  P_.block(at, 0, n, at).setZero();
  P_.block(at, at, n, n) = covariance;
  error_.segment(at, n) = error;
  size_ += n;
  return at;
}

int JointErrors::addFrom(const std::vector<Part>& parts, const ConstMatrix& noiseCovariance,
                         const ConstVector& noise)
{
  const int at = size_, n = static_cast<int>(noise.size());
  Matrix cross = Matrix::Zero(n, at);
  for (const Part& p : parts)
    cross += p.jacobian * columns(p.at, static_cast<int>(p.jacobian.cols())).transpose();
  Matrix own = noiseCovariance;
  Eigen::VectorXd error = noise;
  for (const Part& p : parts)
  {
    own += cross.middleCols(p.at, p.jacobian.cols()) * p.jacobian.transpose();
    error += p.jacobian * error_.segment(p.at, p.jacobian.cols());
  }
  add(0.5 * (own + own.transpose()), error);
  P_.block(at, 0, n, at) = cross;
  return at;
}

void JointErrors::move(int at, const ConstMatrix& F, const ConstMatrix& Q, const ConstVector& noise)
{
  const int n = static_cast<int>(F.rows()), below = size_ - at - n;
  const Matrix own = F * block(at, n) * F.transpose() + Q;
  P_.block(at, at, n, n) = 0.5 * (own + own.transpose());
  P_.block(at, 0, n, at) = F * P_.block(at, 0, n, at).eval();
  P_.block(at + n, at, below, n) = P_.block(at + n, at, below, n).eval() * F.transpose();
  error_.segment(at, n) = F * error_.segment(at, n).eval() - noise;
}

void JointErrors::observe(const std::vector<Row>& rows)
{
  Eigen::Index m = 0;
  for (const Row& row : rows) m += row.variance.size();
  if (m == 0) return;
  // W = P Hᵀ, S = H W + R = L Lᵀ, and P becomes P - W S⁻¹ Wᵀ; the innovation is noise - H error.
  Matrix W = Matrix::Zero(size_, m), S = Matrix::Zero(m, m);
  Eigen::VectorXd innovation(m);
  Eigen::Index first = 0;
  for (const Row& row : rows)
  {
    for (const Part& p : row.parts)
      W.middleCols(first, row.variance.size()).noalias() +=
          columns(p.at, static_cast<int>(p.jacobian.cols())) * p.jacobian.transpose();
    first += row.variance.size();
  }
  first = 0;
  for (const Row& row : rows)
  {
    const Eigen::Index n = row.variance.size();
    innovation.segment(first, n) = row.noise;
    for (const Part& p : row.parts)
    {
      S.middleRows(first, n).noalias() += p.jacobian * W.middleRows(p.at, p.jacobian.cols());
      innovation.segment(first, n) -= p.jacobian * error_.segment(p.at, p.jacobian.cols());
    }
    S.diagonal().segment(first, n) += row.variance;
    first += n;
  }
  const Eigen::LLT<Matrix> llt(S);
  const Matrix V = llt.matrixL().solve(W.transpose()).transpose();
  error_.head(size_) += V * llt.matrixL().solve(innovation);
  P_.topLeftCorner(size_, size_).selfadjointView<Eigen::Lower>().rankUpdate(V, -1.0);
}
}  // namespace slamot::sim
