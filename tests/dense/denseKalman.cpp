#include "denseKalman.h"

#include <Eigen/LU>
#include <cmath>

namespace slamot::test
{
DenseUpdate::DenseUpdate(const Eigen::MatrixXd& P, const Eigen::MatrixXd& H,
                         const Eigen::MatrixXd& R, const Eigen::VectorXd& nu)
{
  const Eigen::MatrixXd S = transformed(H, P) + R;
  gain = times(times(P, H.transpose()), inverse(S));
  cov = P - transformed(gain, S);
  logDensity = logNormal(nu, S);
}

double logNormal(const Eigen::VectorXd& nu, const Eigen::MatrixXd& S)
{
  constexpr double kLogTwoPi = 1.8378770664093454836;
  const Eigen::VectorXd solved = times(inverse(S), nu);
  return -0.5 *
         (nu.dot(solved) + std::log(S.determinant()) + static_cast<double>(nu.size()) * kLogTwoPi);
}

Eigen::MatrixXd transformed(const Eigen::MatrixXd& A, const Eigen::MatrixXd& P)
{
  return times(times(A, P), A.transpose());
}

Eigen::MatrixXd times(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B)
{
  return A * B;
}

Eigen::MatrixXd inverse(const Eigen::MatrixXd& A)
{
  return A.inverse();
}
}  // namespace slamot::test
