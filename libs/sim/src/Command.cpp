#include "Command.h"

namespace slamot::sim
{
namespace
{
// The front axle's middle, to which the pose belongs, goes where the wheel points.
Gaussian<Pose2D> steer(const Motion& m, const Command& command, double dt)
{
  const double c = std::cos(command.turn), s = std::sin(command.turn), way = command.v * dt;
  Gaussian<Pose2D> out;
  out.mean = {way * c, way * s, math::wrapToPi(way * s / m.wheelBase)};
  Eigen::Matrix<double, 3, 2> G;
  G << dt * c, -way * s, dt * s, way * c, dt * s / m.wheelBase, way * c / m.wheelBase;
  const Vector2 q(m.vStd * m.vStd, m.steerStd * m.steerStd);
  const Matrix3 cov = G * q.asDiagonal() * G.transpose();
  out.cov = 0.5 * (cov + cov.transpose());
  return out;
}
}  // namespace

Gaussian<Pose2D> increment(const Motion& m, const Command& command, double dt)
{
  if (m.drive == Motion::Drive::kSteering) return steer(m, command, dt);
  return math::turnThenMove(command.v, command.turn, dt, m.vStd, m.omegaStd);
}
}  // namespace slamot::sim
