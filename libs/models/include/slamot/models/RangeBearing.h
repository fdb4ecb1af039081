#pragma once

#include <slamot/math/geometry.h>

#include <cmath>
#include <stdexcept>

namespace slamot::models
{
/// Range [m] and bearing [rad] from a robot's pose to a point; the bearing from the robot's
/// heading, positive to the left.  Thrun, Burgard, Fox, Probabilistic Robotics, 2005, section 6.6.
class RangeBearing
{
 public:
  /// Below this range [m] the model is singular: such a sighting must be rejected and counted.
  static constexpr double kSmallestRange = 0.01;

  using Z = Vector2;  ///< range [m], bearing [rad]
  /// Derivatives of predict() [m, rad].
  struct Jacobians
  {
    Eigen::Matrix<double, 2, 3> pose;  ///< by (x, y, phi)
    Matrix2 point;                     ///< by (x, y)
  };
  /// What a filter needs of one pair of pose and point, computed together.
  struct Expected
  {
    Z z;        ///< as predict() has it
    Matrix2 H;  ///< by the point; by the pose's (x, y) it is -H
  };

  /// Standard deviations of the sensor [m, rad].
  RangeBearing(double rangeStd, double bearingStd) : rangeStd_(rangeStd), bearingStd_(bearingStd) {}

  /// What the sensor would tell without noise.
  [[nodiscard]] static Z predict(const Pose2D& pose, const Point2D& point)
  {
    const double dx = point.x - pose.x, dy = point.y - pose.y;
    return {std::sqrt(dx * dx + dy * dy), math::wrapToPi(std::atan2(dy, dx) - pose.phi)};
  }
  /// Innovation z - expected, its bearing wrapped.
  [[nodiscard]] static Z residual(const Z& z, const Z& expected)
  {
    return {z[0] - expected[0], math::wrapToPi(z[1] - expected[1])};
  }
  /// \throws std::domain_error below kSmallestRange, where the bearing has no derivative.
  [[nodiscard]] static Jacobians jacobians(const Pose2D& pose, const Point2D& point);
  /// The point that would be seen so.
  [[nodiscard]] static Point2D invert(const Pose2D& pose, const Z& z)
  {
    const double a = pose.phi + z[1];
    return {pose.x + z[0] * std::cos(a), pose.y + z[0] * std::sin(a)};
  }
  /// Derivative of invert() by z: 2x2.
  [[nodiscard]] static Matrix2 invertJacobian(const Pose2D& pose, const Z& z)
  {
    const double c = std::cos(pose.phi + z[1]), s = std::sin(pose.phi + z[1]);
    Matrix2 J;
    J << c, -z[0] * s, s, z[0] * c;
    return J;
  }
  /// Covariance of what it tells: diagonal.
  [[nodiscard]] Matrix2 noise() const
  {
    return Vector2(rangeStd_ * rangeStd_, bearingStd_ * bearingStd_).asDiagonal();
  }

 private:
  double rangeStd_, bearingStd_;
};
}  // namespace slamot::models
