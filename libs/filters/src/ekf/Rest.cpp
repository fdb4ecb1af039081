#include "Rest.h"

namespace slamot::filters::ekf
{
Belief::Rest::Rest(Eigen::VectorXd&& mean, LowerMatrix&& cov, const std::vector<int>& local)
    : x(std::move(mean)), P(std::move(cov)), isLocal_(static_cast<std::size_t>(P.size()), false)
{
  const auto n = static_cast<Eigen::Index>(local.size());
  phi.setIdentity(n, n);
  psi.setZero(n, n);
  theta.setZero(n);
  acrossA.resize(P.size(), n);
  for (Eigen::Index a = 0; a < n; ++a)
    P.columns(local[static_cast<std::size_t>(a)], 1, acrossA.col(a));
  for (const int i : local)
  {
    acrossA.row(i).setZero();
    isLocal_[static_cast<std::size_t>(i)] = true;
  }
}

void Belief::Rest::grow(int k)
{
  phi.conservativeResize(phi.rows() + k, Eigen::NoChange);
  phi.bottomRows(k).setZero();
}

void Belief::Rest::addTo(const Eigen::MatrixXd& rows, double& trace, Eigen::MatrixXd& gram)
{
  if (traceB_ < 0)
  {
    gramB_.noalias() = acrossA.transpose() * acrossA;
    traceB_ = 0;
    for (int i = 0; i < P.size(); ++i)
      if (!isLocal_[static_cast<std::size_t>(i)]) traceB_ += P(i, i);
  }
  const Eigen::MatrixXd full = psi.selfadjointView<Eigen::Lower>();
  trace += scale * (traceB_ - full.cwiseProduct(gramB_).sum());
  gram.noalias() += rows * gramB_ * rows.transpose();
}

Gaussian<Point2D> Belief::Rest::place(int j) const
{
  const Eigen::Matrix<double, 2, Eigen::Dynamic> row = acrossA.middleRows<2>(j);
  const Vector2 mean = x.segment<2>(j) + row * theta;
  const Matrix2 cov =
      scale * (P.block<2, 2>(j, j) - row * psi.selfadjointView<Eigen::Lower>() * row.transpose());
  return {{mean[0], mean[1]}, 0.5 * (cov + cov.transpose())};
}

void Belief::Rest::spread(const Eigen::VectorXd& local, const LowerMatrix& localP,
                          const std::vector<int>& to, int n)
{
  const Eigen::Index before = P.size();
  const Eigen::MatrixXd change = acrossA * psi.selfadjointView<Eigen::Lower>();
  x += acrossA * theta;
  P.subtract(change, acrossA);
  P *= scale;
  P.grow(n);
  x.conservativeResize(n);
  const Eigen::MatrixXd acrossNow = acrossA * phi.transpose();  // B by A now
  for (std::size_t i = 0; i < to.size(); ++i)
  {
    const auto a = static_cast<int>(i);
    x[to[i]] = local[a];
    for (int b = 0; b < before; ++b)
      if (!isLocal_[static_cast<std::size_t>(b)]) P.set(b, to[i], acrossNow(b, a));
    for (std::size_t j = 0; j <= i; ++j) P.set(to[i], to[j], localP(a, static_cast<int>(j)));
  }
}
}  // namespace slamot::filters::ekf
