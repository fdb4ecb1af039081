#pragma once

#include <slamot/math/gaussian.h>

#include <Eigen/LU>

namespace slamot::models
{
/// A target's state vector with its covariance; the first two coordinates are its place (x, y) [m].
template <int N>
struct TargetState
{
  static constexpr int kSize = N;  ///< coordinates

  Eigen::Matrix<double, N, 1> x = Eigen::Matrix<double, N, 1>::Zero();  ///< mean
  Eigen::Matrix<double, N, N> P = Eigen::Matrix<double, N, N>::Zero();  ///< covariance

  /// Its place [m].
  [[nodiscard]] Point2D point() const { return {x[0], x[1]}; }
  /// Covariance of its place [m²].
  [[nodiscard]] Matrix2 pointCov() const { return P.template topLeftCorner<2, 2>(); }

  /// Kalman update.
  /// \param nu innovation. \param S its covariance. \param H its derivative by the place.
  /// \param doubt what is added to -S⁻¹ in the update of P: where S stands for several Gaussians,
  /// what they disagree about.
  template <int M>
  void correct(const Eigen::Matrix<double, M, 1>& nu, const Eigen::Matrix<double, M, M>& S,
               const Eigen::Matrix<double, M, 2>& H,
               const Eigen::Matrix<double, M, M>& doubt = Eigen::Matrix<double, M, M>::Zero())
  {
    const Eigen::Matrix<double, N, M> PHt = P.template leftCols<2>() * H.transpose();
    const Eigen::Matrix<double, N, M> K = PHt * S.inverse();
    x += K * nu;
    P -= K * PHt.transpose();
    if (!doubt.isZero(0)) P += PHt * doubt * PHt.transpose();
    P = (0.5 * (P + P.transpose())).eval();
  }
};

/// How a target's errors go on over a step: P becomes F P Fᵀ + Q.
template <int N>
struct TargetTransition
{
  Eigen::Matrix<double, N, N> F =
      Eigen::Matrix<double, N,
                    N>::Identity();  ///< derivative of the later state by the earlier one
  Eigen::Matrix<double, N, N> Q = Eigen::Matrix<double, N, N>::Zero();  ///< what is added meanwhile

  /// Moves a covariance on; it comes out symmetric.  Built once: N is 4, 5 or 6.
  void applyTo(Eigen::Matrix<double, N, N>& P) const;
};

/// Place, velocity and, with K = 6, acceleration of a target in map axes, x before y.
template <int K, int N>
struct Kinematics
{
  Eigen::Matrix<double, K, 1> value;     ///< x, y [m], vx, vy [m/s] and, with K = 6, ax, ay [m/s²]
  Eigen::Matrix<double, K, N> jacobian;  ///< by the target's state
};

// Every model of a target's motion has: State; start(), birth(); move(State&, dt), which moves the
// mean and returns the transition; predict(State&, dt), move() with the covariance;
// afterCorrection(); pose(), velocity(), kinematics(), kinematicTransition(), hasVelocity(),
// widen().
}  // namespace slamot::models
