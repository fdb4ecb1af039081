#pragma once

#include <slamot/core/Config.h>
#include <slamot/math/gaussian.h>

#include <array>
#include <map>
#include <optional>

namespace slamot::core
{
/// What is known of one object's start, in the map frame; what is absent is unknown.
struct ObjectStart
{
  /// Places in `value` and `std`; axes of the map frame.
  enum Field
  {
    kX,      ///< [m]
    kY,      ///< [m]
    kTheta,  ///< heading [rad]
    kVx,     ///< [m/s]
    kVy,     ///< [m/s]
    kAx,     ///< [m/s²]
    kAy,     ///< [m/s²]
    kCount   ///< how many there are
  };
  std::array<std::optional<double>, kCount> value;  ///< [m, m, rad, m/s, m/s, m/s², m/s²]
  std::array<std::optional<double>, kCount> std;    ///< their standard deviations

  /// A value, or `otherwise` where it is unknown.
  [[nodiscard]] double get(Field f, double otherwise = 0) const
  {
    return value[f].value_or(otherwise);
  }
  /// A standard deviation, or `otherwise` where none is given.
  [[nodiscard]] double getStd(Field f, double otherwise = 0) const
  {
    return std[f].value_or(otherwise);
  }

  /// Pose with deviations; what is absent is zero, exactly.
  [[nodiscard]] Gaussian<Pose2D> pose() const;
};

/// Where the robot and its targets start, and when.
/// In an ini: section [start] with keys `time_s` and `<object>_<field>`, object `robot` or
/// `target_<id>`, field x_m y_m theta_rad vx_mps vy_mps ax_mps2 ay_mps2, each also as std_....
struct Starts
{
  std::optional<double> time;          ///< [s]
  std::optional<ObjectStart> robot;    ///< absent: it starts at the origin
  std::map<int, ObjectStart> targets;  ///< by identity; others start at their first sighting

  /// The robot's start; without one, the origin, exactly.
  [[nodiscard]] Gaussian<Pose2D> robotPose() const
  {
    return robot ? robot->pose() : Gaussian<Pose2D>{};
  }

  /// Reads [start]; empty if there is none.  \throws Error (kConfig) on a key or value that is
  /// wrong.
  static Starts from(Config& config);
  /// The section's text, which from() reads back without loss.
  [[nodiscard]] std::string toIni() const;
};
}  // namespace slamot::core
