#include <slamot/importers/WheelNoise.h>

namespace slamot::importers
{
Gaussian<Pose2D> WheelNoise::held(double v, double omega, double dt) const
{
  const double turned = std::abs(omega) * dt;
  const double distanceStd =
      std::sqrt(distance * distance * dt + distanceTurning * distanceTurning * turned);
  const double headingStd =
      std::sqrt(heading * heading * dt + headingTurning * headingTurning * turned);
  Gaussian<Pose2D> out = math::turnThenMove(v, omega, dt, distanceStd / dt, headingStd / dt);
  // The chord of the arc points along the mean of the headings.
  const double half = 0.5 * omega * dt;
  const double chord = v * dt * (std::abs(half) < 1e-6 ? 1 : std::sin(half) / half);
  out.mean = {chord * std::cos(half), chord * std::sin(half), math::wrapToPi(omega * dt)};
  return out;
}
}  // namespace slamot::importers
