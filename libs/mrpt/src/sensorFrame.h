#pragma once

#include <mrpt/poses/CPose3D.h>
#include <slamot/core/Step.h>

namespace slamot::mrpt
{
/// What a sensor on a robot sees, taken to the robot's frame and into the plane.
class SensorFrame
{
 public:
  explicit SensorFrame(const ::mrpt::poses::CPose3D& pose_robot_sensor);

  struct RangeBearing
  {
    double range = 0, bearing = 0;  ///< [m, rad], in the robot's plane
    double rangeStd = 0, bearingStd = 0;
  };
  /// A point at `polar`, (range [m], yaw [rad], pitch [rad], positive downwards), with covariance.
  /// Its height is dropped.  A range of zero comes back for a point above the robot's origin.
  [[nodiscard]] RangeBearing point(const Vector3& polar, const Matrix3& cov) const;

  /// The bearing of a direction [rad].  The sensor's offset from the robot's origin is left out: it
  /// can't be known how far away the thing is.
  [[nodiscard]] double bearing(double yaw, double pitch) const;

  /// The part of `fov` (about the sensor's axis) that lies in (-pi, pi] of the robot's bearings. Of
  /// a view across the robot's back that is the larger side: what is called in view surely is.
  [[nodiscard]] core::FieldOfView view(core::FieldOfView fov) const;

 private:
  Matrix3 rotation_;
  Vector3 offset_;
};

/// What two sensors see as one: the hull where they overlap, else the wider one.
[[nodiscard]] core::FieldOfView join(const core::FieldOfView& a, const core::FieldOfView& b);
}  // namespace slamot::mrpt
