#pragma once

#include <slamot/core/Step.h>
#include <slamot/models/NoiseLaw.h>
#include <slamot/sim/Motion.h>
#include <slamot/sim/RawSensors.h>

#include <array>
#include <map>
#include <string>
#include <utility>

namespace slamot::sim
{
/// What is told to a filter about an object's start: the truth with an error drawn from these.
struct StartKnowledge
{
  bool known = true;                      ///< false: nothing is told
  std::array<double, 3> std{0, 0, 0};     ///< of x, y, theta [m, m, rad]
  std::optional<double> velocityStd;      ///< of vx and vy [m/s]; absent: velocity is not told
  std::optional<double> accelerationStd;  ///< of ax and ay [m/s²]; absent: it is not told
};

/// A robot of the world: how it drives, and what it carries.
struct RobotSetup
{
  std::string section = "robot";  ///< of the scenario, for messages
  Motion motion;                  ///< where it starts and, unless it follows, how it drives
  StartKnowledge start;           ///< what its filter may know of that
  bool following = false;         ///< drives after a target instead of by its own motion
  int followed = 0;               ///< that target's id
  double followSide = 0;          ///< heads for a point this far left of it, across its motion [m]
  double followDistance = 1;      ///< keeps this far from that point [m]
  double followGain = 2;          ///< speed by distance [1/s]
  double followSpeedRatio = 1;    ///< its top speed by the target's
  Look look{0.2, 0.4, 355, 0.85, 0.8};  ///< to the others' lasers and cameras
  std::optional<LaserSetup> laser;      ///< absent: it has none
  std::optional<CameraSetup> camera;    ///< absent: it has none
};

/// A target of the world.
struct TargetSetup
{
  Motion motion;                       ///< where it starts and how it moves
  StartKnowledge start;                ///< what a filter may know of that
  std::string label = "target";        ///< of its blobs
  Look look{0.2, 0.5, 25, 0.9, 0.85};  ///< to lasers and cameras
  /// Spans [from, until) in which it is there [s from the log's start]; empty: always.
  std::vector<std::pair<double, double>> present;

  /// Whether it is there at a time [s from the log's start].
  [[nodiscard]] bool isPresent(double time) const;
};

/// A sensor at the robot's origin, looking ahead.
struct SensorSetup
{
  core::FieldOfView fov;      ///< where it looks: what is in it may be seen
  double rangeStd = 0.1;      ///< [m]
  double bearingStd = 0.008;  ///< [rad]
  /// If above 0, instead of those: of a place's x and y [m], which is then told as range and
  /// bearing.  Of blobs.
  double positionStd = 0;
  /// Now and then an error is larger than those tell; null: never.
  std::shared_ptr<const models::NoiseLaw> glint = {};
  double detection = 1;                 ///< chance that an object in view is seen
  double clutter = 0;                   ///< false sightings a scan, mean
  bool identities = true;               ///< whether it tells which one it saw
  bool bearingOnly = false;             ///< of blobs
  std::string clutterLabel = "target";  ///< of false blobs
  std::string label = "robot";          ///< of the mate sensor's true blobs
};

/// Landmarks: where they are, or how they are placed at random.
struct LandmarkSetup
{
  std::vector<Point2D> positions;  ///< given ones, instead of
  int count = 0;                   ///< placed ones
  bool alongPath = false;     ///< within a band on either side of the robots' paths, else anywhere
  double pathMin = 0;         ///< of the band, from the path [m]
  double pathMax = 0;         ///< of the band, from the path [m]
  int clusterSize = 1;        ///< so many stand together
  double clusterSpacing = 1;  ///< from a member of a cluster to the nearest other one [m]
  double spacing = 0;  ///< smallest distance between two of them, or of different clusters [m]
  Look look{0.1, 1.2, 60, 0.1, 0.35};  ///< to lasers and cameras: posts
};

/// A world to simulate.  Sections [world]; [robot], or [robot_0], [robot_1], ... for a team;
/// [target] or [target_<id>]; [landmark_sensor]; [target_sensor], which a world without targets and
/// mates may leave out; [mate_sensor] if robots see one another; [laser] and [camera], if there are
/// such, or [laser_0], [camera_1], ... in their place for one robot of a team.
/// config-ini/sim.experiment1.ini comments every key.
struct Scenario
{
  std::string name;                         ///< of its file, for messages
  Area area;                                ///< in which random places lie
  double startTime = 0;                     ///< of the log [s]
  double dt = 0.025;                        ///< of a step [s]
  int steps = 320;                          ///< of odometry
  int scanEvery = 8;                        ///< steps from one scan to the next
  LandmarkSetup landmarks;                  ///< where they are
  std::vector<RobotSetup> robots;           ///< at least one
  std::map<int, TargetSetup> targets;       ///< [target] is number 1
  SensorSetup landmarkSensor;               ///< of every robot, as the others
  std::optional<SensorSetup> targetSensor;  ///< absent: nothing looks for blobs
  std::optional<SensorSetup> mateSensor;    ///< for the other robots; absent: not seen
  bool sightings = true;    ///< whether these three report; false: laser and camera alone
  std::vector<Wall> walls;  ///< that lasers meet and cameras see

  /// Reads the sections; config.requireAllRead() then finds what nobody knows.
  /// \throws core::Error (kConfig).
  static Scenario from(core::Config& config);
};
}  // namespace slamot::sim
