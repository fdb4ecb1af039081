#pragma once

#include <optional>
#include <string>
#include <vector>

// Data as somebody else would simulate and write it: uses nothing of slamot's, only what the manual
// says of CSV folders.
namespace slamot::test
{
struct StrangersTarget
{
  int id;
  std::string label;
};

/// What a drive is like, and what of it is written down.
struct StrangersDrive
{
  unsigned seed = 1;
  double duration = 60;  ///< [s]
  double startTime = 0;  ///< the clock's reading at the start [s]
  bool landmarkIds = true, targetIds = true;
  bool increments = false;    ///< odometry.csv with increments in place of velocities
  bool robotStart = true;     ///< start.csv, where the frame's origin is not the robot's start
  bool targetStarts = false;  ///< start.csv has the targets too
  double bearingsOnly = 0;    ///< part of the blobs that have no range
  double halfFov = 2.4;       ///< seen up to this bearing [rad]
  double declaredRange = 8;   ///< fov.csv; the sensor sees up to 8 m
  double pauseAt = -1;        ///< from this time [s] on stands still for 60 s, as one row
  double blindFrom = 1e9, blindTo = 1e9;  ///< scans see nothing
  std::vector<StrangersTarget> targets = {{3, "target"}, {7, "target"}};
};

/// What was written, for comparison.
struct StrangersFacts
{
  int steps = 0, scans = 0, sightings = 0, blobs = 0;
  int outOfDeclaredView = 0;  ///< sightings and blobs, with those at range 0 or below
  int posts = 0;
};

/// Drives once and writes the folder, which must be there.
StrangersFacts writeStrangersData(const std::string& folder, const StrangersDrive& drive);
}  // namespace slamot::test
