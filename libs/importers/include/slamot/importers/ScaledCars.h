#pragma once

#include <slamot/importers/Import.h>
#include <slamot/importers/WheelNoise.h>

#include <memory>
#include <optional>
#include <string>

namespace slamot::importers
{
/// What is told of the ego car, its laser and the truth in the scaled cars' runs.  The defaults of
/// geometry and noise were measured against the truth; see doc/importing.md.
struct ScaledCarsOptions
{
  /// Where the robot's rate of turn is taken from.
  enum class Heading
  {
    kImu,    ///< its gyroscope, less the bias
    kWheels  ///< the difference of the front wheels' speeds
  };
  Heading heading = Heading::kImu;  ///< what tells the rate of turn
  double wheelRadius = 0.0312;      ///< of the front wheels, effective [m]
  double wheelbase = 0.25;          ///< [m]
  double track = 0.15;              ///< between the front wheels, effective [m]
  double ahead = 0.12;              ///< of the robot's frame, from the rear axle [m]
  std::optional<double> gyroBias;   ///< [rad/s]; none: the mean over the rest at the start
  Pose2D mount{-0.12, 0, 0};        ///< of the laser, in the robot's frame
  double laserDelay = 0;            ///< scans were taken this long before their times [s]
  double maxRange = 8;              ///< farther is no return [m]
  WheelNoise wheels{0.02, 0.02, math::degToRad(0.3), 0.003};  ///< of odometry

  bool startFromTruth = true;  ///< start in the truth's frame; else at the origin, exactly
  bool targetStarts = false;   ///< tell also where the targets truly start
  /// What is made of the headings that the motion capture tells.
  enum class TrueHeading
  {
    kAligned,  ///< turned by the angle at which cars drive where they head
    kLogged,   ///< as they are
    kNone      ///< left out of the truth
  };
  TrueHeading trueHeading = TrueHeading::kAligned;  ///< which of these
};

/// Opens one run of the scaled cars: a folder with scan.csv, wheel_speeds.csv and imu.csv and, each
/// optional, ego_pose.csv, target_pose.csv and target<id>_pose.csv, plain or gz.
///
/// The robot's frame is that of ego_pose.  The front wheels' mean speed is that of the front axle,
/// v, and the rear axle's sqrt(v² - (L omega)²); speeds and rates are held until the next row.  A
/// step ends at each scan.  Scans before odometry begins, or after it ends, are left out and
/// counted. The truth has the times of the steps, and none within gaps of over 0.1 s.  Its headings
/// are turned, car by car, by one angle such that the car drives where it heads; where driving does
/// not agree with any such angle, they are not known, which a warning says. \throws core::Error as
/// the tables' reader does; kUnreadable without a truth to start from.
std::unique_ptr<Import> openScaledCars(const std::string& folder, const ScaledCarsOptions& options);
}  // namespace slamot::importers
