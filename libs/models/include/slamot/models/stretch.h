#pragma once

#include <Eigen/Core>

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

/// The Stretch from one covariance to another, both N x N, N of 4 and 6; the same in all axes.
/// \param from,to positive semidefinite.
/// \param shrinkOnly T is the identity where `to` is the larger, and else shrinks; otherwise it may
/// stretch, and `left` is what `from` knows exactly and `to` does not.
template <int N>
[[nodiscard]] Stretch<N> stretch(const Eigen::Matrix<double, N, N>& from,
                                 const Eigen::Matrix<double, N, N>& to, bool shrinkOnly);
}  // namespace slamot::models
