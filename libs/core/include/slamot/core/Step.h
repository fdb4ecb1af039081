#pragma once

#include <slamot/math/gaussian.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace slamot::core
{
inline constexpr int kNoId = -1;  ///< the sensor can't tell which one it saw

/// Where a sensor can see, in its robot's frame.  Bearings are positive to the left.
struct FieldOfView
{
  double rangeMin = 0;             ///< [m]
  double rangeMax = 1e6;           ///< [m]
  double bearingMin = -math::kPi;  ///< [rad]
  double bearingMax = math::kPi;   ///< [rad]

  /// Whether a thing at this range [m] and bearing [rad], wrapped, is in view; borders are.
  [[nodiscard]] bool contains(double range, double bearing) const
  {
    return range >= rangeMin && range <= rangeMax && bearing >= bearingMin && bearing <= bearingMax;
  }
};

/// A landmark, seen from the robot's frame.
struct Sighting
{
  double range = 0;       ///< [m]
  double bearing = 0;     ///< [rad], from the robot's heading, positive to the left
  double rangeStd = 0;    ///< [m]
  double bearingStd = 0;  ///< [rad]
  int id = kNoId;         ///< which landmark it is, if the sensor can tell
};

/// A colour blob that stands for a target or a team mate, seen from the robot's frame.
struct Blob
{
  std::string label;            ///< what it is: "target", "robot", ...
  std::optional<double> range;  ///< [m]; absent: bearing only
  double bearing = 0;           ///< [rad]
  double rangeStd = 0;          ///< [m]; meaningless without a range
  double bearingStd = 0;        ///< [rad]
  int id = kNoId;               ///< which target or team mate it is, if the sensor can tell
};

/// What one sensor reported at once.  An empty list is a scan that saw nothing, which is news.
struct LandmarkScan
{
  FieldOfView fov;  ///< where the sensor looked: what is in it and not in the list was missed
  std::vector<Sighting> sightings;  ///< in no order
};
/// As a LandmarkScan, of targets and team mates.
struct BlobScan
{
  FieldOfView fov;  ///< where the sensor looked: what is in it and not in the list was missed
  std::vector<Blob> blobs;  ///< in no order
};

/// A laser scan: ranges from angleMin on, in steps of angleStep.
struct LaserScan
{
  Pose2D pose_robot_sensor;   ///< of the sensor in its robot's frame
  double angleMin = 0;        ///< [rad], of the first range, in the sensor's frame
  double angleStep = 0;       ///< [rad]; positive: counter-clockwise
  double rangeMax = 0;        ///< [m]; a longer range is no return
  std::vector<float> ranges;  ///< [m]
};

/// All that one robot reports for one instant.
struct Step
{
  double time = 0;                           ///< [s], the log's own clock
  std::optional<Gaussian<Pose2D>> odometry;  ///< increment since the last step, in its frame
  std::optional<LandmarkScan> landmarks;     ///< absent: no scan was taken
  std::optional<BlobScan> blobs;             ///< absent: no camera looked
  std::vector<std::shared_ptr<const LaserScan>> lasers;  ///< one for each laser that scanned
  int dropped = 0;  ///< sightings and blobs that the source left out (range <= 0, out of view)
};
}  // namespace slamot::core
