#pragma once

#include <slamot/core/Estimate.h>

namespace slamot::filters::rbpf
{
/// How uncertain it is where the whole map lies.  What the filter knows, it knows from its first
/// scan on relative to the pose of that scan; how well that pose itself is known, no later sighting
/// can tell.  Particles that each guessed it would keep, resampled in time, one guess at random
/// and no doubt: so it stays out of them, a Gaussian of its own.  What a team tells moves the whole
/// map, and its doubt comes in here too.
class MapFrame
{
 public:
  MapFrame() = default;
  /// \param firstPose with the covariance that the first scan was taken with, in map axes.
  explicit MapFrame(const Gaussian<Pose2D>& firstPose) : first_(firstPose) {}

  void addTo(Gaussian<Pose2D>& pose) const { pose.cov += covAt(pose.mean.x, pose.mean.y); }
  void addTo(Gaussian<Point2D>& point) const
  {
    point.cov += covAt(point.mean.x, point.mean.y).topLeftCorner<2, 2>();
  }
  /// What it adds to the covariance of a pose at (x, y).
  [[nodiscard]] Matrix3 covAt(double x, double y) const
  {
    const Matrix3 T = lever(x, y);
    return T * first_.cov * T.transpose();
  }
  void addTo(core::TargetEstimate& target) const
  {
    addTo(target.pose);
    const Vector2 turned(-target.velocity[1], target.velocity[0]);
    target.velocityCov += first_.cov(2, 2) * turned * turned.transpose();
  }

 private:
  /// Of a pose there, by the first pose.
  [[nodiscard]] Matrix3 lever(double x, double y) const
  {
    Matrix3 T = Matrix3::Identity();
    T(0, 2) = first_.mean.y - y;
    T(1, 2) = x - first_.mean.x;
    return T;
  }

  Gaussian<Pose2D> first_;
};
}  // namespace slamot::filters::rbpf
