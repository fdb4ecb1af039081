#include "AcceleratedPoint.h"

#include <algorithm>
#include <cmath>

namespace slamot::sim
{
namespace
{
constexpr double kDamping = 0.7;  // zeta: hardly overshoots
constexpr int kParts = 10;        // of a step, each integrated at once
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

void AcceleratedPoint::move(double dt, math::RandomStream& random)
{
  const double h = dt / kParts;
  for (int i = 0; i < kParts; ++i)
  {
    const Vector2 before = velocity();
    pace_.move(h, random.normal());
    turn_.move(h, random.normal());
    const Vector2 mean = 0.5 * (before + velocity());
    at_ = {at_.x + mean.x() * h, at_.y + mean.y() * h};
  }
}
}  // namespace slamot::sim
