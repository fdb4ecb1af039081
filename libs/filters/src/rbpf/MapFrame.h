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
  [[nodiscard]] Matrix3 covAt(double x, double y) const;
  void addTo(core::TargetEstimate& target) const;

 private:
  Gaussian<Pose2D> first_;
};
}  // namespace slamot::filters::rbpf
