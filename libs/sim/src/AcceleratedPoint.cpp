#include "AcceleratedPoint.h"

#include <algorithm>
#include <cmath>

#include "starts.h"

namespace slamot::sim
{
namespace
{
constexpr double kDamping = 0.7;   // zeta: hardly overshoots
constexpr int kParts = 10;         // of a step, each integrated at once
constexpr double kExactly = 1e24;  // information that leaves no doubt
}  // namespace

AcceleratedPoint::Spring::Spring(double q, double l)
    : noise(q), limit(l), rate(std::cbrt(q * q / (4 * kDamping * l * l / 9)))
{
}

void AcceleratedPoint::Spring::move(double h, double normal)
{
  // Position after speed: stays stable for all rates that a scenario may have.
  speed += (-2 * kDamping * rate * speed - rate * rate * x) * h + noise * std::sqrt(h) * normal;
  x += speed * h;
}

Matrix2 AcceleratedPoint::Spring::transition(double h) const
{
  const Vector2 speedBy(-rate * rate * h, 1 - 2 * kDamping * rate * h);
  Matrix2 out;
  out << 1 + h * speedBy[0], h * speedBy[1], speedBy[0], speedBy[1];
  return out;
}

Vector2 AcceleratedPoint::Spring::gain(double h) const
{
  return {h * noise * std::sqrt(h), noise * std::sqrt(h)};
}

AcceleratedPoint::AcceleratedPoint(const Motion& motion, const Pose2D& start)
    : speed0_(motion.speed),
      start_(start),
      at_{start.x, start.y},
      pace_(motion.jerkNoise, motion.speedBand),
      turn_(motion.jerkNoise / motion.speed, motion.cone)
{
}

double AcceleratedPoint::springRate(const Motion& m)
{
  return std::max(Spring(m.jerkNoise, m.speedBand).rate,
                  Spring(m.jerkNoise / m.speed, m.cone).rate);
}

Vector2 AcceleratedPoint::velocity() const
{
  const double speed = speed0_ + pace_.value();
  return {speed * std::cos(direction()), speed * std::sin(direction())};
}

Eigen::Matrix<double, 2, AcceleratedPoint::kSize> AcceleratedPoint::velocityJacobian() const
{
  const Vector2 v = velocity();
  Eigen::Matrix<double, 2, kSize> out = Eigen::Matrix<double, 2, kSize>::Zero();
  out.col(2) = v.normalized() * pace_.slope();
  out.col(4) = Vector2(-v.y(), v.x()) * turn_.slope();
  return out;
}

Eigen::Matrix<double, AcceleratedPoint::kSize, 1> AcceleratedPoint::startStd(
    const StartKnowledge& k) const
{
  Eigen::Matrix<double, kSize, 1> out;
  const Vector2 pace = pace_.longRun(), turn = turn_.longRun();
  out << kUnknownPlace, kUnknownPlace, pace, turn;
  if (!k.known) return out;
  out[0] = k.std[0];
  out[1] = k.std[1];
  // The direction is told by itself, and by the velocity.
  double information = k.std[2] > 0 ? 1 / (k.std[2] * k.std[2]) : kExactly;
  if (k.velocityStd)
  {
    out[2] = *k.velocityStd;
    information += *k.velocityStd > 0 ? std::pow(speed0_ / *k.velocityStd, 2) : kExactly;
  }
  out[4] = information >= kExactly ? 0 : 1 / std::sqrt(information);
  if (k.accelerationStd)
  {
    out[3] = *k.accelerationStd;
    out[5] = *k.accelerationStd / speed0_;
  }
  return out;
}

void AcceleratedPoint::move(double dt, math::RandomStream& random, Linear* linear)
{
  const double h = dt / kParts;
  for (int i = 0; i < kParts; ++i)
  {
    const Vector2 before = velocity();
    Eigen::Matrix<double, 2, kSize> jacobianBefore;
    if (linear) jacobianBefore = velocityJacobian();
    const double pace = random.normal(), turn = random.normal();
    pace_.move(h, pace);
    turn_.move(h, turn);
    const Vector2 mean = 0.5 * (before + velocity());
    at_ = {at_.x + mean.x() * h, at_.y + mean.y() * h};
    if (linear) extend(*linear, h, jacobianBefore, {pace, turn});
  }
}

void AcceleratedPoint::extend(Linear& linear, double h,
                              const Eigen::Matrix<double, 2, kSize>& before,
                              const Vector2& deviates) const
{
  using Square = Eigen::Matrix<double, kSize, kSize>;
  Square springs = Square::Identity();
  springs.block<2, 2>(2, 2) = pace_.transition(h);
  springs.block<2, 2>(4, 4) = turn_.transition(h);
  Eigen::Matrix<double, kSize, 2> gain = Eigen::Matrix<double, kSize, 2>::Zero();
  gain.block<2, 1>(2, 0) = pace_.gain(h);
  gain.block<2, 1>(4, 1) = turn_.gain(h);
  const Eigen::Matrix<double, 2, kSize> after = velocityJacobian();
  Square F = springs;
  F.topRows<2>() += 0.5 * h * (before + after * springs);
  gain.topRows<2>() = 0.5 * h * after * gain;
  linear.w = (F * linear.w + gain * deviates).eval();
  linear.F = (F * linear.F).eval();
  linear.Q = (F * linear.Q * F.transpose() + gain * gain.transpose()).eval();
}
}  // namespace slamot::sim
