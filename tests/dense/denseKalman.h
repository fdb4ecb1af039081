#pragma once

#include <Eigen/Core>

// Kalman's formulas as the books have them, compiled once: each test that writes them out with
// Eigen's own matrices takes five seconds more to build.
namespace slamot::test
{
/// An update of N(x, P) by nu = H (x - mean) + noise of covariance R.
struct DenseUpdate
{
  Eigen::MatrixXd gain;  ///< K = P Hᵀ S⁻¹
  Eigen::MatrixXd cov;   ///< P - K S Kᵀ
  double logDensity;     ///< ln N(nu; 0, S), S = H P Hᵀ + R

  DenseUpdate(const Eigen::MatrixXd& P, const Eigen::MatrixXd& H, const Eigen::MatrixXd& R,
              const Eigen::VectorXd& nu);
};
/// ln N(nu; 0, S).
double logNormal(const Eigen::VectorXd& nu, const Eigen::MatrixXd& S);
/// A P Aᵀ.
Eigen::MatrixXd transformed(const Eigen::MatrixXd& A, const Eigen::MatrixXd& P);
/// A B.
Eigen::MatrixXd times(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);
/// By elimination.
Eigen::MatrixXd inverse(const Eigen::MatrixXd& A);
}  // namespace slamot::test
