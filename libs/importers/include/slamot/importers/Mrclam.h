#pragma once

#include <slamot/importers/Import.h>
#include <slamot/importers/WheelNoise.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace slamot::importers
{
inline constexpr int kMrclamRobots = 5;  ///< of every dataset; subjects 1 to 5

/// Which robot of an MRCLAM dataset, and what is told of its sensors.  The defaults of noise were
/// measured on dataset 6 against its truth; see doc/importing.md.
struct MrclamOptions
{
  int robot = 0;              ///< 1 to 5
  bool landmarkIds = true;    ///< sightings keep the landmark's subject number
  bool targetIds = true;      ///< blobs keep the other robot's subject number
  std::optional<int> target;  ///< robot that the others track: labelled `target`, always told apart
  bool hideLandmarks = false;  ///< steps without landmarks
  bool startFromTruth = true;  ///< start in the truth's frame; else at the origin, exactly
  double maxStep = 0.1;        ///< [s], of odometry between camera images
  double odometryDelay = 0;    ///< [s], by which motion follows the logged velocity

  WheelNoise wheels{0.007, 0.08, math::degToRad(0.4), 0.15};  ///< of odometry
  double rangeStd = 0.05;                                     ///< [m], of a landmark close by
  double rangeScaleStd = 0.04;              ///< part of the range, added in squares
  double bearingStd = math::degToRad(0.8);  ///< [rad]
};

/// Opens a dataset of the UTIAS Multi-Robot Cooperative Localization and Mapping collection: a
/// folder with Barcodes.dat, RobotN_Odometry.dat and RobotN_Measurement.dat, and for the truth
/// Landmark_Groundtruth.dat and RobotM_Groundtruth.dat, each plain or gz.
///
/// Landmarks become sightings, the other robots blobs labelled `robot`.  With a target, that one's
/// blobs are labelled `target`, and it alone is among the truth's targets: the others are team
/// mates.  A velocity is held until the next row of odometry.  Every camera image ends a step, and
/// between images a step ends at least every maxStep.  Measurements of barcodes that no subject but
/// the robot itself has are left out and counted.  The field of view is the hull of what the robot
/// measured.  The truth has the times of the steps, and none within gaps of over 0.5 s.  Times stay
/// those of the data.
/// \throws core::Error (kConfig) on a robot or target that is none, a robot that is its own target,
/// or deviations that are zero; as the tables' reader does.
std::unique_ptr<Import> openMrclam(const std::string& folder, const MrclamOptions& options);

/// All robots but a target, in rising order.  \throws core::Error (kConfig) on a target that is
/// none.
std::vector<int> mrclamTeam(int target);
}  // namespace slamot::importers
