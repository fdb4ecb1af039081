#pragma once

#include <slamot/core/Start.h>
#include <slamot/core/Step.h>

namespace slamot::laws
{
/// A small world in memory: a robot on a circle among landmarks, and targets on theirs.  All noise
/// is normal, of the deviations that the steps and starts tell, so that a filter set up for it is
/// on its own model.
struct World
{
  int steps = 60;             ///< of odometry
  double dt = 0.1;            ///< [s]
  double speed = 1.0;         ///< of the robot, as odometry tells [m/s]
  double turnRate = 0.4;      ///< of the robot, as odometry tells [rad/s]
  double speedStd = 0.1;      ///< of the true speed about that, drawn anew each step [m/s]
  double turnRateStd = 0.05;  ///< of the true turn rate, drawn anew each step [rad/s]
  /// Of a factor on the distance travelled, drawn once a drive, about 1: a systematic error, as of
  /// worn wheels, that the steps do not tell.
  double speedScaleStd = 0;
  int landmarks = 12;              ///< uniform in a square about the robot's circle
  double halfSide = 6.0;           ///< of that square [m]
  int scanEvery = 4;               ///< [steps]
  double rangeMax = 8.0;           ///< of the sensor, which sees all round [m]
  double rangeStd = 0.1;           ///< of sightings of landmarks and targets [m]
  double bearingStd = 0.02;        ///< of sightings of landmarks and targets [rad]
  bool identities = true;          ///< whether the sensor tells which landmark it saw
  int targets = 1;                 ///< labelled `target`, with identities from 0 on
  double targetSpeed = 0.8;        ///< known to the filter [m/s]
  double targetTurnRate = 0.2;     ///< known to the filter [rad/s]
  double targetSpeedStd = 0.1;     ///< about that, drawn anew each step [m/s]
  double targetTurnRateStd = 0.1;  ///< about that, drawn anew each step [rad/s]
  double targetStartStd = 0.1;     ///< of the known start's x, y [m] and heading [rad]
};

/// One drive through a world: what the filter gets, and the truth.
struct Drive
{
  core::Starts starts;            ///< exact for the robot, with World::targetStartStd for targets
  std::vector<core::Step> steps;  ///< odometry in each, scans every World::scanEvery
  std::vector<Pose2D> robot;      ///< true pose after each step
  std::vector<std::vector<Pose2D>> targets;  ///< per step, by identity
};

/// The drive that the seed fixes, laid out from the robot's start: another start is the same world
/// moved and rotated, with the same steps.
[[nodiscard]] Drive drive(const World& world, std::uint64_t seed, const Pose2D& start = {});
}  // namespace slamot::laws
