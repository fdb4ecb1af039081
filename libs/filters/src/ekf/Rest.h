#pragma once

#include "Belief.h"

namespace slamot::filters::ekf
{
/// What Belief keeps while some landmarks are local: everything as it was at focus(), and the sums
/// that say how it has changed since.  A: what is local, B: the rest.
struct Belief::Rest
{
  /// \param local the coordinates that are local now.
  Rest(Eigen::VectorXd&& mean, LowerMatrix&& cov, const std::vector<int>& local);

  /// Further local coordinates, uncorrelated.
  void grow(int k);
  /// A Kalman update, U = L⁻¹ H Phi and nu = L⁻¹ innovation, with S = L Lᵀ.
  void take(const Eigen::MatrixXd& U, const Eigen::VectorXd& nu)
  {
    theta.noalias() += U.transpose() * nu;
    const ReadOnly Ut = ReadOnly::transposeOf(U);
    addProduct(1 / scale, Ut, Ut, psi.data(), psi.outerStride(), true);
  }
  /// Adds B's places to tr(E P Eᵀ) and Wᵀ EᵀE W, with rows = H Phi.
  void addTo(const Eigen::MatrixXd& rows, double& trace, Eigen::MatrixXd& gram);
  /// A place of B, which begins at j of x.
  [[nodiscard]] Gaussian<Point2D> place(int j) const;
  /// Carries out the change on x and P, which have n coordinates then; local coordinate i is at
  /// to[i].
  void spread(const Eigen::VectorXd& local, const LowerMatrix& localP, const std::vector<int>& to,
              int n);

  Eigen::VectorXd x;        // of A and B at focus()
  LowerMatrix P;            // of A and B at focus()
  Eigen::MatrixXd acrossA;  // P0 by the columns of A, rows of A zero
  Eigen::MatrixXd phi;      // A now by A then
  Eigen::MatrixXd psi;      // A then by A then: lower triangle
  Eigen::VectorXd theta;    // A then
  double scale = 1;

 private:
  // For the criterion of fusion, made when first asked for.
  Eigen::MatrixXd gramB_;  // acrossAᵀ acrossA
  double traceB_ = -1;
  std::vector<bool> isLocal_;
};
}  // namespace slamot::filters::ekf
