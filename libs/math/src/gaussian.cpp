#include <slamot/math/eigensystem.h>
#include <slamot/math/gaussian.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace slamot::math
{
Gaussian<Pose2D> compose(const Gaussian<Pose2D>& pose, const Gaussian<Pose2D>& increment)
{
  Gaussian<Pose2D> out;
  out.mean = compose(pose.mean, increment.mean);
  Matrix3 F = Matrix3::Identity();
  F(0, 2) = -(out.mean.y - pose.mean.y);
  F(1, 2) = out.mean.x - pose.mean.x;
  const Matrix3 R = poseRotation(pose.mean.phi);
  const Matrix3 cov = F * pose.cov * F.transpose() + R * increment.cov * R.transpose();
  out.cov = 0.5 * (cov + cov.transpose());
  return out;
}

Gaussian<Pose2D> turnThenMove(double v, double omega, double dt, double stdV, double stdOmega)
{
  const double c = std::cos(omega * dt), s = std::sin(omega * dt);
  Gaussian<Pose2D> out;
  out.mean = {v * dt * c, v * dt * s, wrapToPi(omega * dt)};
  Eigen::Matrix<double, 3, 2> G;
  G << dt * c, -v * dt * dt * s, dt * s, v * dt * dt * c, 0.0, dt;
  const Eigen::Vector2d q(stdV * stdV, stdOmega * stdOmega);
  const Matrix3 cov = G * q.asDiagonal() * G.transpose();
  out.cov = 0.5 * (cov + cov.transpose());
  return out;
}

Matrix3 squareRoot(const Matrix3& cov)
{
  if (!cov.allFinite()) throw std::domain_error("covariance is not finite");
  // Eigenvectors rather than Cholesky: a control with two noises makes a rank of two.
  const auto [d, V] = eigensystem<3>(cov);
  if (d[0] < -1e-8 * std::max(d[2], 1e-300))
    throw std::domain_error("covariance has a negative eigenvalue");
  return V * d.cwiseMax(0.0).cwiseSqrt().asDiagonal() * V.transpose();
}

Ellipse ellipse(const Matrix2& cov)
{
  const double mean = 0.5 * (cov(0, 0) + cov(1, 1)), half = 0.5 * (cov(0, 0) - cov(1, 1));
  const double radius = std::hypot(half, cov(0, 1));
  return {std::sqrt(std::max(mean + radius, 0.0)), std::sqrt(std::max(mean - radius, 0.0)),
          0.5 * std::atan2(cov(0, 1), half)};
}

double asymmetry(const Eigen::Ref<const Eigen::MatrixXd>& m)
{
  return (m - m.transpose()).cwiseAbs().maxCoeff();
}

double mahalanobisSquared(const Eigen::Ref<const Eigen::VectorXd>& e,
                          const Eigen::Ref<const Eigen::MatrixXd>& P)
{
  const Eigen::LLT<Eigen::MatrixXd> llt(P);
  if (llt.info() != Eigen::Success) throw std::domain_error("covariance is not positive definite");
  return llt.matrixL().solve(e).squaredNorm();
}
}  // namespace slamot::math
