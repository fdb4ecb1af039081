#pragma once

#include <slamot/math/geometry.h>

namespace slamot
{
/// Number of coordinates of a state: 3 for a pose, 2 for a point.
template <class S>
inline constexpr int kDim = 0;
template <>
/// x [m], y [m], phi [rad].
inline constexpr int kDim<Pose2D> = 3;
template <>
/// x, y [m].
inline constexpr int kDim<Point2D> = 2;

/// A mean and a covariance over the state's coordinates, in the axes that the mean is given in
/// ([m, m, rad] for a pose).
template <class S>
struct Gaussian
{
  S mean{};  ///< expected state
  /// In the same axes; zero: known exactly.
  Eigen::Matrix<double, kDim<S>, kDim<S>> cov = Eigen::Matrix<double, kDim<S>, kDim<S>>::Zero();
};
}  // namespace slamot

namespace slamot::math
{
/// Pose after an uncertain increment in the pose's own frame; independent errors, first order.
[[nodiscard]] Gaussian<Pose2D> compose(const Gaussian<Pose2D>& pose,
                                       const Gaussian<Pose2D>& increment);

/// Increment of a robot that turns by omega dt first and then moves by v dt (see the CSV format),
/// with independent deviations of v [m/s] and omega [rad/s] over the step of dt [s].
[[nodiscard]] Gaussian<Pose2D> turnThenMove(double v, double omega, double dt, double stdV,
                                            double stdOmega);

/// The symmetric square root L, L Lᵀ = cov, of a symmetric positive semidefinite 3x3 matrix, also
/// singular.  It follows small changes of cov by small changes, also where eigenvalues are equal.
/// \throws std::domain_error if cov is not finite or has an eigenvalue below -1e-8 of its largest.
[[nodiscard]] Matrix3 squareRoot(const Matrix3& cov);

/// Where a Gaussian of two coordinates [m] has one deviation.
struct Ellipse
{
  double longer;     ///< half axis [m]
  double shorter;    ///< half axis [m]
  double direction;  ///< of the longer one [rad]
};
/// Of a covariance [m²] symmetric and positive semidefinite. By formula: Eigen's solver for this
/// size takes eight seconds to build.
[[nodiscard]] Ellipse ellipse(const Matrix2& cov);

/// Largest difference between a matrix and its transpose.
[[nodiscard]] double asymmetry(const Eigen::Ref<const Eigen::MatrixXd>& m);

/// Smallest eigenvalue of a symmetric matrix; NaN if it holds one.
[[nodiscard]] double smallestEigenvalue(const Eigen::Ref<const Eigen::MatrixXd>& m);

/// Squared Mahalanobis length eᵀ P⁻¹ e.  \throws std::domain_error if P is not positive definite.
[[nodiscard]] double mahalanobisSquared(const Eigen::Ref<const Eigen::VectorXd>& e,
                                        const Eigen::Ref<const Eigen::MatrixXd>& P);
}  // namespace slamot::math
