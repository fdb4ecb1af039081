#pragma once

#include <Eigen/Core>

namespace slamot::math
{
/// What a symmetric matrix does along its own axes.
template <int N>
struct Eigensystem
{
  Eigen::Matrix<double, N, 1> values;   ///< eigenvalues, ascending
  Eigen::Matrix<double, N, N> vectors;  ///< of length 1, a column each
};

/// Of a symmetric matrix, of which the lower triangle is read; for N of 3, 4, 6 and Eigen::Dynamic.
/// Eigen's solver, built once: it takes four seconds to build for each N, wherever it is used.
template <int N>
[[nodiscard]] Eigensystem<N> eigensystem(const Eigen::Matrix<double, N, N>& m);

/// What is left of a symmetric matrix, when its negative eigenvalues are zero; N of
/// 4 and 6.
template <int N>
[[nodiscard]] Eigen::Matrix<double, N, N> withoutNegative(const Eigen::Matrix<double, N, N>& m);
}  // namespace slamot::math
