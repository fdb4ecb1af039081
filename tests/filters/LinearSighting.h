#pragma once

#include <slamot/models/RangeBearing.h>

#include <Eigen/LU>

namespace slamot::test
{
/// A sighting of an uncertain point, linearised by the definition, with matrices: what the filter's
/// inner loop is compared with.
struct LinearSighting
{
  Vector2 nu;                          ///< what is seen less what is expected
  Eigen::Matrix<double, 2, 3> byPose;  ///< derivatives of what is expected
  Matrix2 byPoint;
  Matrix2 R;
  bool near;  ///< which coordinates they are in: the ray's frame, or polar

  [[nodiscard]] Matrix2 S(const Matrix2& P) const { return byPoint * P * byPoint.transpose() + R; }
};

/// Range and bearing.
inline LinearSighting inPolar(const Pose2D& pose, const Point2D& m, const Vector2& z,
                              const models::RangeBearing& model)
{
  const auto J = models::RangeBearing::jacobians(pose, m);
  const Vector2 nu = models::RangeBearing::residual(z, models::RangeBearing::predict(pose, m));
  return {nu, J.pose, J.point, model.noise(), false};
}

/// Columns: the unit vectors along an angle and across it.
inline Matrix2 axesAt(double angle)
{
  return (Matrix2() << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle))
      .finished();
}

/// The axes are along the sighting's ray and across it, so that they turn with the pose.  What is
/// seen lies at (range, 0).  Across, metres become radians by the root mean square of the true
/// range, which is the measured one plus noise.
inline LinearSighting inRaysFrame(const Pose2D& pose, const Point2D& m, const Vector2& z,
                                  const models::RangeBearing& model)
{
  const double trueRange = std::sqrt(z[0] * z[0] + model.noise()(0, 0));
  const Matrix2 unit = Vector2(1, 1 / trueRange).asDiagonal();
  const Vector2 d(m.x - pose.x, m.y - pose.y);
  const double ray = pose.phi + z[1];
  const Matrix2 axes = axesAt(ray);
  LinearSighting out;
  out.nu = unit * (Vector2(z[0], 0) - axes.transpose() * d);
  out.byPoint = unit * axes.transpose();
  out.byPose.leftCols<2>() = -out.byPoint;
  // A rotation's derivative is the rotation by a quarter turn more.
  out.byPose.col(2) = unit * axesAt(ray + math::kPi / 2).transpose() * d;
  out.R = model.noise();
  out.near = true;
  return out;
}

/// In the ray's frame up to eight standard deviations, of point and range together; else in polar.
inline LinearSighting linearise(const Pose2D& pose, const Point2D& m, const Matrix2& P,
                                const Vector2& z, const models::RangeBearing& model)
{
  const double std = std::sqrt(P.trace() + model.noise()(0, 0));
  const bool near = std::hypot(m.x - pose.x, m.y - pose.y) < 8 * std;
  return near ? inRaysFrame(pose, m, z, model) : inPolar(pose, m, z, model);
}
}  // namespace slamot::test
