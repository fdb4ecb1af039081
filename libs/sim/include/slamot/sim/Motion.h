#pragma once

#include <slamot/core/Params.h>
#include <slamot/math/geometry.h>

#include <optional>
#include <vector>

namespace slamot::sim
{
/// The rectangle [0, width] x [0, height] of the map frame [m].
struct Area
{
  double width = 10;   ///< along x [m]
  double height = 10;  ///< along y [m]

  /// Its middle, in the map frame [m].
  [[nodiscard]] Point2D centre() const { return {width / 2, height / 2}; }
  /// Whether a point is inside, at least `border` [m] from every side.
  [[nodiscard]] bool contains(const Point2D& p, double border = 0) const
  {
    return p.x >= border && p.y >= border && p.x <= width - border && p.y <= height - border;
  }
};

/// Where an object starts and how it is driven: the keys that robots and targets share.
struct Motion
{
  /// What an object does.
  enum class Kind
  {
    kCircle,       ///< constant speed and turn rate, starting on the circle
    kWaypoints,    ///< steers from point to point
    kStraight,     ///< constant speed
    kManoeuvre,    ///< constant speed; the turn rate changes its sign at random times
    kCommand,      ///< constant speed and turn rate from wherever it starts
    kAccelerated,  ///< a point (targets only): nearly constant acceleration, never turning back
    kWhiteAcceleration  ///< a point (targets only): acceleration drawn anew each step
  };
  /// What a body's second control does to it.
  enum class Drive
  {
    kTurnRate,  ///< turns by omega dt, then moves by v dt: eq. 32 of Xin, Jia, Gou 2014, corrected
    kSteering  ///< a bicycle's front wheel: moves by v dt where the wheel points, turns by v dt sin
               ///< G / L
  };
  /// Where it begins to.
  enum class StartAt
  {
    kPath,       ///< on the circle, or at the first waypoint facing the next
    kGiven,      ///< start_x_m, start_y_m, start_theta_deg
    kRandom,     ///< uniform in the area, any heading
    kNearTarget  ///< so far from the first target, inside the area, facing it
  };

  Kind kind = Kind::kCircle;         ///< which of these
  double speed = 0;                  ///< [m/s]
  double turnRate = 0;               ///< of command and manoeuvre [rad/s]
  Point2D centre{5, 5};              ///< of the circle, in the map frame [m]
  double radius = 3;                 ///< [m]
  bool clockwise = false;            ///< on the circle; else counter-clockwise
  std::optional<double> phase;       ///< where on the circle it starts [rad]; absent: at random
  std::vector<Point2D> waypoints;    ///< in the map frame [m], in this order
  bool loop = true;                  ///< from the last waypoint to the first, else stop there
  double reached = 0.5;              ///< a waypoint is passed at this distance [m]
  double turnGain = 4;               ///< turn rate by bearing to where it steers [1/s]
  double turnMax = 3;                ///< and its limit [rad/s]
  double switchMin = 1;              ///< time between changes of the manoeuvre's sign,
  double switchMax = 3;              ///< uniform between these [s]
  double border = 1;                 ///< a manoeuvre turns back this far from the area's sides [m]
  double jerkNoise = 0;              ///< of accelerated motion, white [m/s³ per square root of Hz]
  double speedBand = 1;              ///< its speed stays this near to `speed` [m/s]
  double cone = 0.7;                 ///< its direction stays this near to that of the start [rad]
  double accelerationStd = 0;        ///< of white acceleration, per axis of the map [m/s²]
  StartAt startAt = StartAt::kPath;  ///< which of these
  Pose2D start;                      ///< if given
  double startDistance = 4;          ///< from the target, if near it [m]
  Drive drive = Drive::kTurnRate;    ///< which of these
  double wheelBase = 4;              ///< L, of steering [m]
  double steerMax = 0.5;             ///< the wheel's angle G stays within +-this [rad]
  double steerRateMax = 0.35;        ///< and changes no faster than this [rad/s]
  double vStd = 0;                   ///< of the executed speed, drawn anew each step [m/s]
  double omegaStd = 0;               ///< of the executed turn rate, drawn anew each step [rad/s]
  double steerStd = 0;               ///< of the wheel's angle, in place of omega's [rad]

  /// Reads the keys from p.  \throws core::Error (kConfig).
  static Motion from(core::Params& p, const Area& area);

  /// Whether it is a point that moves by itself, and no body that is driven.
  [[nodiscard]] bool isPoint() const
  {
    return kind == Kind::kAccelerated || kind == Kind::kWhiteAcceleration;
  }
  /// Whether it has a path in the plane: a circle, or waypoints.
  [[nodiscard]] bool hasPath() const;
  /// How far a point is from that path [m]; of waypoints, from the lines that join them.
  [[nodiscard]] double distanceToPath(const Point2D& p) const;
};
}  // namespace slamot::sim
