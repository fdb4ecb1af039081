#include <cmath>

#include "BoxState.h"

namespace slamot::moving
{
using B = BoxState;

// The middle is axle + d u(heading).  Over dt the axle goes v dt along the heading halfway.
void predict(BoxState& s, double dt, const MovingOptions& options)
{
  if (dt <= 0) return;
  const double d = options.axleBehind, phi = s.x[B::kPhi], v = s.x[B::kSpeed], w = s.x[B::kTurn];
  const double half = phi + 0.5 * w * dt, after = phi + w * dt;
  const double c0 = std::cos(phi), s0 = std::sin(phi), ch = std::cos(half), sh = std::sin(half);
  const double c1 = std::cos(after), s1 = std::sin(after);
  s.x[B::kX] += v * dt * ch + d * (c1 - c0);
  s.x[B::kY] += v * dt * sh + d * (s1 - s0);
  s.x[B::kPhi] = math::wrapToPi(after);
  B::Matrix F = B::Matrix::Identity();
  F(B::kX, B::kPhi) = -v * dt * sh - d * (s1 - s0);
  F(B::kY, B::kPhi) = v * dt * ch + d * (c1 - c0);
  F(B::kX, B::kSpeed) = dt * ch;
  F(B::kY, B::kSpeed) = dt * sh;
  F(B::kX, B::kTurn) = -0.5 * v * dt * dt * sh - d * dt * s1;
  F(B::kY, B::kTurn) = 0.5 * v * dt * dt * ch + d * dt * c1;
  F(B::kPhi, B::kTurn) = dt;
  s.P = (F * s.P * F.transpose()).eval();
  // Speed and turn rate walk during the step, and move the box meanwhile.
  const auto walk = [&](int rate, double q)
  {
    B::Vector g = F.col(rate) / dt;
    g[rate] = 0;
    s.P += q * (dt * dt * dt / 3) * (g * g.transpose());
    s.P.col(rate) += q * (dt * dt / 2) * g;
    s.P.row(rate) += q * (dt * dt / 2) * g.transpose();
    s.P(rate, rate) += q * dt;
  };
  walk(B::kSpeed, options.speedWalk * options.speedWalk);
  walk(B::kTurn, options.turnWalk * options.turnWalk);
  const Vector2 across(-sh, ch);
  s.P.topLeftCorner<2, 2>() += options.slide * options.slide * dt * across * across.transpose();
  s.P = (0.5 * (s.P + s.P.transpose())).eval();
}

BoxPoint pointOf(const BoxState& s, double ahead, const MovingOptions& options)
{
  const double c = std::cos(s.x[B::kPhi]), sn = std::sin(s.x[B::kPhi]);
  const double v = s.x[B::kSpeed], w = s.x[B::kTurn], lever = ahead + options.axleBehind;
  BoxPoint out;
  out.pose.mean = {s.x[B::kX] + ahead * c, s.x[B::kY] + ahead * sn, s.x[B::kPhi]};
  Eigen::Matrix<double, 3, 3> J = Matrix3::Identity();
  J(0, 2) = -ahead * sn;
  J(1, 2) = ahead * c;
  out.pose.cov = J * s.P.topLeftCorner<3, 3>() * J.transpose();
  out.velocity = {v * c - w * lever * sn, v * sn + w * lever * c};
  Eigen::Matrix<double, 2, 3> V;  // by heading, speed, turn rate
  V << -out.velocity[1], c, -lever * sn, out.velocity[0], sn, lever * c;
  out.velocityCov = V * s.P.block<3, 3>(B::kPhi, B::kPhi) * V.transpose();
  return out;
}
}  // namespace slamot::moving
