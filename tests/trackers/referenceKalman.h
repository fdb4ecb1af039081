#pragma once

#include "glintWorld.h"

#include <slamot/models/NoiseLaw.h>

#include <Eigen/LU>

namespace slamot::test
{
/// A Gaussian over (x, y, vx, vy), and the textbook's steps of it, with nothing shared with the
/// filters.
struct Kalman
{
  Eigen::Vector4d x = Eigen::Vector4d::Zero();
  Eigen::Matrix4d P = Eigen::Matrix4d::Zero();
  double logWeight = 0;

  explicit Kalman(const core::ObjectStart& s)
  {
    using S = core::ObjectStart;
    int i = 0;
    for (const S::Field f : {S::kX, S::kY, S::kVx, S::kVy})
    {
      x[i] = *s.value[f];
      P(i, i) = *s.std[f] * *s.std[f];
      ++i;
    }
  }
  void predict(double dt, double accelerationStd)
  {
    Eigen::Matrix4d F = Eigen::Matrix4d::Identity();
    F(0, 2) = F(1, 3) = dt;
    Eigen::Matrix<double, 4, 2> G;
    G << dt * dt / 2, 0, 0, dt * dt / 2, dt, 0, 0, dt;
    x = (F * x).eval();
    P = (F * P * F.transpose() + accelerationStd * accelerationStd * G * G.transpose()).eval();
  }
  void update(const Vector2& nu, const Eigen::Matrix<double, 2, 4>& H, const Matrix2& R)
  {
    const Matrix2 S = H * P * H.transpose() + R;
    const Eigen::Matrix<double, 4, 2> K = P * H.transpose() * S.inverse();
    logWeight += -0.5 * nu.dot(S.inverse() * nu) - 0.5 * std::log(S.determinant());
    x += K * nu;
    P = ((Eigen::Matrix4d::Identity() - K * H) * P).eval();
  }
  /// The place that a blob tells, seen from the origin at 45 degrees, with these deviations.
  void updatePlace(const core::Blob& b, double variance)
  {
    const double a = math::kPi / 4 + b.bearing;
    const Vector2 z(*b.range * std::cos(a), *b.range * std::sin(a));
    Eigen::Matrix<double, 2, 4> H = Eigen::Matrix<double, 2, 4>::Identity();
    update(z - H * x, H, variance * Matrix2::Identity());
  }
  void updatePolar(const core::Blob& b)
  {
    const double r = std::hypot(x[0], x[1]);
    Eigen::Matrix<double, 2, 4> H = Eigen::Matrix<double, 2, 4>::Zero();
    H << x[0] / r, x[1] / r, 0, 0, -x[1] / (r * r), x[0] / (r * r), 0, 0;
    const Vector2 nu(*b.range - r,
                     math::wrapToPi(b.bearing + math::kPi / 4 - std::atan2(x[1], x[0])));
    update(nu, H, Vector2(b.rangeStd * b.rangeStd, b.bearingStd * b.bearingStd).asDiagonal());
  }
};

/// Moments of weighted Gaussians.
inline Kalman merged(const std::vector<Kalman>& parts)
{
  double most = -1e300, sum = 0;
  for (const Kalman& k : parts) most = std::max(most, k.logWeight);
  Kalman out = parts[0];
  out.x.setZero();
  for (const Kalman& k : parts) sum += std::exp(k.logWeight - most);
  for (const Kalman& k : parts) out.x += std::exp(k.logWeight - most) / sum * k.x;
  out.P.setZero();
  for (const Kalman& k : parts)
    out.P += std::exp(k.logWeight - most) / sum * (k.P + (k.x - out.x) * (k.x - out.x).transpose());
  out.logWeight = most + std::log(sum);
  return out;
}

/// Each of the Gaussians split by those of a law, with a place taken in: exact.
inline std::vector<Kalman> split(const std::vector<Kalman>& parts, const core::Blob& b,
                                 const models::NoiseLaw& law)
{
  std::vector<Kalman> out;
  for (const Kalman& k : parts)
    for (const auto& c : law.components())
    {
      out.push_back(k);
      out.back().logWeight += std::log(c.weight);
      out.back().updatePlace(b, c.factor * b.rangeStd * b.rangeStd);
    }
  return out;
}

inline void expectNear(const core::TargetEstimate& e, const Kalman& k, double place, double speed,
                       double cov)
{
  EXPECT_NEAR(e.pose.mean.x, k.x[0], place);
  EXPECT_NEAR(e.pose.mean.y, k.x[1], place);
  EXPECT_NEAR(e.velocity.x(), k.x[2], speed);
  EXPECT_NEAR(e.velocity.y(), k.x[3], speed);
  const Matrix2 p = k.P.topLeftCorner<2, 2>(), v = k.P.bottomRightCorner<2, 2>();
  EXPECT_LE((e.pose.cov.topLeftCorner<2, 2>() - p).norm(), cov * p.norm());
  EXPECT_LE((e.velocityCov - v).norm(), cov * v.norm());
}
}  // namespace slamot::test
