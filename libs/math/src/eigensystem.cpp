#include <slamot/math/eigensystem.h>
#include <slamot/math/gaussian.h>

#include <Eigen/Eigenvalues>
#include <limits>

namespace slamot::math
{
template <int N>
Eigensystem<N> eigensystem(const Eigen::Matrix<double, N, N>& m)
{
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, N, N>> solver(m);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

template <int N>
Eigen::Matrix<double, N, N> withoutNegative(const Eigen::Matrix<double, N, N>& m)
{
  const Eigensystem<N> e = eigensystem<N>(m);
  return e.vectors * e.values.cwiseMax(0).asDiagonal() * e.vectors.transpose();
}

double smallestEigenvalue(const Eigen::Ref<const Eigen::MatrixXd>& m)
{
  if (!m.allFinite()) return std::numeric_limits<double>::quiet_NaN();
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(m, Eigen::EigenvaluesOnly).eigenvalues()[0];
}

template Eigensystem<3> eigensystem(const Eigen::Matrix<double, 3, 3>&);
template Eigensystem<4> eigensystem(const Eigen::Matrix<double, 4, 4>&);
template Eigensystem<6> eigensystem(const Eigen::Matrix<double, 6, 6>&);
template Eigensystem<Eigen::Dynamic> eigensystem(const Eigen::MatrixXd&);
template Eigen::Matrix<double, 4, 4> withoutNegative(const Eigen::Matrix<double, 4, 4>&);
template Eigen::Matrix<double, 6, 6> withoutNegative(const Eigen::Matrix<double, 6, 6>&);
}  // namespace slamot::math
