#pragma once

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

// Linear maps from one covariance to another, for what else is correlated with the errors.
namespace slamot::models
{
/// Errors e of covariance `from` become T e + w, cov(w) = left >= 0, and have covariance `to`.
template <int N>
struct Stretch
{
  Eigen::Matrix<double, N, N> T;     ///< the map
  Eigen::Matrix<double, N, N> left;  ///< covariance of w
};

/// The Stretch from one covariance to another, both N x N; the same in all axes.
/// \param from,to positive semidefinite.
/// \param shrinkOnly T is the identity where `to` is the larger, and else shrinks; otherwise it may
/// stretch, and `left` is what `from` knows exactly and `to` does not.
template <int N>
Stretch<N> stretch(const Eigen::Matrix<double, N, N>& from, const Eigen::Matrix<double, N, N>& to,
                   bool shrinkOnly)
{
  using Matrix = Eigen::Matrix<double, N, N>;
  using Vector = Eigen::Matrix<double, N, 1>;
  using Eigenvectors = Eigen::SelfAdjointEigenSolver<Matrix>;
  const auto symmetric = [](const Matrix& M) { return Matrix(0.5 * (M + M.transpose())); };
  constexpr double kExact = 1e-13;  // of the largest variance: known exactly
  // In coordinates where `from` is the identity, but for those that it knows exactly: what of `to`
  // is left in the others given these.
  const Eigenvectors a(from);
  const Vector root = a.eigenvalues().cwiseMax(0).cwiseSqrt();
  Vector inverse = Vector::Zero();
  for (int i = 0; i < N; ++i)
    if (a.eigenvalues()[i] > kExact * a.eigenvalues()[N - 1]) inverse[i] = 1 / root[i];
  const Matrix R = a.eigenvectors() * root.asDiagonal() * a.eigenvectors().transpose();
  const Matrix I = a.eigenvectors() * inverse.asDiagonal() * a.eigenvectors().transpose();
  const Matrix some = to + kExact * to.trace() * Matrix::Identity();
  const Eigenvectors g(symmetric(R * some.inverse() * R));
  Vector by = Vector::Zero();
  for (int i = 0; i < N; ++i)
    if (g.eigenvalues()[i] > kExact) by[i] = 1 / std::sqrt(g.eigenvalues()[i]);
  if (shrinkOnly) by = by.cwiseMin(1);
  Stretch<N> out;
  out.T = R * g.eigenvectors() * by.asDiagonal() * g.eigenvectors().transpose() * I;
  const Eigenvectors left(symmetric(to - out.T * from * out.T.transpose()));
  out.left = left.eigenvectors() * left.eigenvalues().cwiseMax(0).asDiagonal() *
             left.eigenvectors().transpose();
  return out;
}
}  // namespace slamot::models
