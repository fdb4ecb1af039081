#include <slamot/importers/DrivenNoise.h>

namespace slamot::importers
{
Gaussian<Pose2D> DrivenNoise::of(const Pose2D& increment) const
{
  const double driven = std::hypot(increment.x, increment.y), turned = std::abs(increment.phi);
  const double both = distanceTurning * distanceTurning * turned;
  const double headingVar = heading * heading * driven + headingTurning * headingTurning * turned;
  // Heading walks on the way: at its end it has moved the robot sideways by its mean over the way.
  Matrix3 cov = Matrix3::Zero();
  cov(0, 0) = distance * distance * driven + both;
  cov(1, 1) = slip * slip * driven + both + headingVar * driven * driven / 3;
  cov(1, 2) = cov(2, 1) = headingVar * driven / 2;
  cov(2, 2) = headingVar;
  const Matrix3 r = math::poseRotation(driven > 0 ? std::atan2(increment.y, increment.x) : 0);
  const Matrix3 turnedCov = r * cov * r.transpose();
  return {increment, 0.5 * (turnedCov + turnedCov.transpose())};
}
}  // namespace slamot::importers
