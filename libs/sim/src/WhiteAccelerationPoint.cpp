#include "WhiteAccelerationPoint.h"

#include "starts.h"

namespace slamot::sim
{
namespace
{
constexpr double kUnknownSpeed = 1e3;  // deviation of a velocity that nobody tells [m/s]
}  // namespace

WhiteAccelerationPoint::WhiteAccelerationPoint(const Motion& motion, const Pose2D& start)
    : accelerationStd_(motion.accelerationStd),
      x_(start.x, start.y, motion.speed * std::cos(start.phi), motion.speed * std::sin(start.phi))
{
}

void WhiteAccelerationPoint::move(double dt, math::RandomStream& random, Linear* linear)
{
  Linear step;
  step.F.topRightCorner<2, 2>() = dt * Matrix2::Identity();
  Eigen::Matrix<double, kSize, 2> G;  // of the state by the acceleration
  G << 0.5 * dt * dt * Matrix2::Identity(), dt * Matrix2::Identity();
  const double x = random.normal(), y = random.normal();
  step.w = accelerationStd_ * G * Vector2(x, y);
  step.Q = accelerationStd_ * accelerationStd_ * G * G.transpose();
  x_ = (step.F * x_ + step.w).eval();
  if (linear) *linear = step;
}

WhiteAccelerationPoint::State WhiteAccelerationPoint::startStd(const StartKnowledge& k) const
{
  if (!k.known) return {kUnknownPlace, kUnknownPlace, kUnknownSpeed, kUnknownSpeed};
  const double speed = k.velocityStd.value_or(kUnknownSpeed);
  return {k.std[0], k.std[1], speed, speed};
}
}  // namespace slamot::sim
