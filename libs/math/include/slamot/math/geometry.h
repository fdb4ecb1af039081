#pragma once

#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPose2D.h>

#include <Eigen/Core>
#include <cmath>

namespace slamot
{
/// A pose (x [m], y [m], phi [rad]) in the plane: MRPT's own type.
using Pose2D = ::mrpt::math::TPose2D;
/// A point (x, y) [m] in the plane: MRPT's own type.
using Point2D = ::mrpt::math::TPoint2D;

using Vector2 = Eigen::Matrix<double, 2, 1>;  ///< a point, a velocity, a range and bearing
using Vector3 = Eigen::Matrix<double, 3, 1>;  ///< coordinates (x, y, phi) of a pose
using Matrix2 = Eigen::Matrix<double, 2, 2>;  ///< a covariance of Vector2
using Matrix3 = Eigen::Matrix<double, 3, 3>;  ///< a covariance of Vector3
}  // namespace slamot

namespace slamot::math
{
inline constexpr double kPi = 3.14159265358979323846;  ///< half a turn [rad]
inline constexpr double kTwoPi = 2.0 * kPi;            ///< a turn [rad]

/// The same angle in (-pi, pi] [rad].  NaN stays NaN.
[[nodiscard]] inline double wrapToPi(double angle)
{
  if (angle > -kPi && angle <= kPi) return angle;
  const double wrapped = angle - kTwoPi * std::round(angle / kTwoPi);
  if (wrapped > kPi) return wrapped - kTwoPi;  // the quotient rounded down to a half less
  return wrapped <= -kPi ? wrapped + kTwoPi : wrapped;
}

/// Degrees are for files and people, radians for everything else.
[[nodiscard]] constexpr double degToRad(double degrees)
{
  return degrees * (kPi / 180.0);
}
/// The inverse of degToRad().
[[nodiscard]] constexpr double radToDeg(double radians)
{
  return radians * (180.0 / kPi);
}

/// pose_a_c from pose_a_b and pose_b_c: the frame c, given in b, expressed in a.
[[nodiscard]] inline Pose2D compose(const Pose2D& a, const Pose2D& b)
{
  const double c = std::cos(a.phi), s = std::sin(a.phi);
  return {a.x + c * b.x - s * b.y, a.y + s * b.x + c * b.y, wrapToPi(a.phi + b.phi)};
}

/// pose_b_c from pose_a_b and pose_a_c: compose(from, between(from, to)) == to.
[[nodiscard]] inline Pose2D between(const Pose2D& from, const Pose2D& to)
{
  const double c = std::cos(from.phi), s = std::sin(from.phi);
  const double dx = to.x - from.x, dy = to.y - from.y;
  return {c * dx + s * dy, -s * dx + c * dy, wrapToPi(to.phi - from.phi)};
}

/// A point of the pose's frame, in the frame that the pose is given in.
[[nodiscard]] inline Point2D transform(const Pose2D& pose, const Point2D& p)
{
  const double c = std::cos(pose.phi), s = std::sin(pose.phi);
  return {pose.x + c * p.x - s * p.y, pose.y + s * p.x + c * p.y};
}

/// The rotation by `angle` [rad] of the plane, heading untouched: 3x3 on (x, y, phi).
[[nodiscard]] inline Matrix3 poseRotation(double angle)
{
  Matrix3 r = Matrix3::Identity();
  r(0, 0) = r(1, 1) = std::cos(angle);
  r(1, 0) = std::sin(angle);
  r(0, 1) = -r(1, 0);
  return r;
}
}  // namespace slamot::math
