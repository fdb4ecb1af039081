#pragma once

#include <slamot/perception/fitCircle.h>

namespace slamot::perception
{
/// What a camera sees, taken into the robot's plane.
struct Gaze
{
  Point2D from;           ///< the camera's place, in the robot's frame [m]
  double bearing = 0;     ///< from the robot's heading, positive to the left [rad]
  double bearingStd = 0;  ///< [rad]
};

/// How a blob gets its range from the laser.
struct RangingOptions
{
  /// What is done with a blob that several things may be of.
  enum class Ambiguous
  {
    kRefuse,   ///< the bearing alone is kept
    kNearest,  ///< what is behind is hidden
    kKeep      ///< one blob for each
  };
  Roundness object{0.2, 0.05};               ///< the thing's outline: its colour's
  double gate = 3;                           ///< deviations between blob and object
  int leastPoints = 2;                       ///< of the laser on the thing
  double mostMisfit = 25;                    ///< see CircleFit::misfit: things are seldom round
  Ambiguous ambiguous = Ambiguous::kRefuse;  ///< which of these

  /// Keys gate_sigmas, min_points, max_misfit, ambiguous (refuse, nearest,
  /// keep).
  static RangingOptions from(core::Params& p);
};

/// A thing that a blob may be of.
struct RangedObject
{
  Gaussian<Point2D> center;  ///< in the robot's frame: the laser's, and the camera's bearing
  double range = 0;          ///< from the camera [m]
  double rangeStd = 0;       ///< [m]
  double bearing = 0;        ///< seen from the camera, from the robot's heading [rad]
  double bearingStd = 0;     ///< [rad]
  std::size_t cluster = 0;   ///< its place in the list
};

/// The things among a laser's clusters that a blob may be of, nearest first: whose centre lies in
/// the blob's direction within the gate, as surely as both know it.
/// \param gaze in the robot's frame at the image's time.
/// \param robot_image_scan where the robot was at the scan's time, from where it was at the
/// image's. \param scan,clusters in the robot's frame at the scan's time.
[[nodiscard]] std::vector<RangedObject> objectsSeen(
    const Gaze& gaze, const Pose2D& robot_image_scan, const core::LaserScan& scan,
    const std::vector<Cluster>& clusters, const LaserOptions& laser, const RangingOptions& options);
}  // namespace slamot::perception
