#pragma once

#include <slamot/importers/CarMotion.h>
#include <slamot/importers/Import.h>

#include <memory>
#include <string>

namespace slamot::importers
{
/// What is told of the car and its sensors in Victoria Park.  The defaults of noise were measured
/// on the log itself, without GPS; see doc/importing.md.
struct VictoriaParkOptions
{
  CarGeometry car;            ///< its measures, and where the laser sits
  double steeringOffset = 0;  ///< added to the logged steering [rad]
  double steeringScale = 1;   ///< by which the logged steering is multiplied first
  double laserYaw = 0;        ///< of the laser against the car's x axis, positive to the left [rad]
  double laserDelay = 0;      ///< scans were taken this long before their times [s]

  CarNoise noise{0.03, math::degToRad(1.6), math::degToRad(3), 1};  ///< of speed and steering
  double trunkStd = 0.05;                   ///< of a trunk's middle, along and across the ray [m]
  double rangeScaleStd = 0.004;             ///< part of the range, added in squares
  double bearingStd = math::degToRad(0.2);  ///< [rad], added in squares

  double maxRange = 80;  ///< farther trees are left out, and the field of view ends there [m]
  bool lasers = false;   ///< deliver the laser scans too
};

/// Opens the Victoria Park log: a folder with inputs.txt, trees.txt and, each optional,
/// laser_cm.txt and gps_first_600s.txt, plain or gz.  It is read as it is delivered.
///
/// The robot's frame is at the laser's mount, its axes parallel to the car's: x ahead.  Speed and
/// steering are held until their next row.  A step ends at each scan and at the last row of
/// inputs, and lasts 1 s at the most.  Scans are the laser's, also where no tree was seen, and
/// those that only trees tell of; without laser_cm.txt the latter alone, which a warning says.
/// Trees have no identity.  The truth is the GPS fixes at their own times, without heading, of the
/// antenna, wherever that is.  Times stay those of the data but for laserDelay.
/// \throws core::Error as the tables' reader does; kConfig on deviations that are zero.
std::unique_ptr<Import> openVictoriaPark(const std::string& folder,
                                         const VictoriaParkOptions& options);
}  // namespace slamot::importers
