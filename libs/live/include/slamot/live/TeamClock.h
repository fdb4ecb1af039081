#pragma once

#include <slamot/live/Beacon.h>

namespace slamot::live
{
/// Seconds since 1970, that never go back while the program runs.
[[nodiscard]] double wallTime();

/// The time in a team's logs, which runs with the wall's.  Either its start is given, then it stays
/// as it is; or it begins when this robot does and is put forward to the clock of anybody who is
/// ahead.  So all who hear each other agree, up to the way of a packet, without wall clocks that
/// agree, and a robot that comes late or again is where the others are.
class TeamClock
{
 public:
  /// When the clock begins, and how fast it goes.
  struct Options
  {
    double zero = 0;                ///< time in the log at the start [s]
    double speed = 1;               ///< of the log's clock against the wall's
    std::optional<double> startAt;  ///< by wallTime(); absent: now
  };
  /// More than that ahead is no clock of the same team [s].
  static constexpr double kFarthest = 86'400;

  /// `wall` is the wall's time now [s].
  TeamClock(const Options& options, double wall);

  /// Time in the log at a wall time [s].
  [[nodiscard]] double at(double wall) const
  {
    return options_.zero + (wall - start_) * options_.speed;
  }
  /// When a time in the log is, by the wall [s].
  [[nodiscard]] double wallAt(double clock) const
  {
    return start_ + (clock - options_.zero) / options_.speed;
  }

  /// Takes in what another's clock was just now; by how much that put this one forward [s].
  double hear(const Beacon& beacon, double wall);
  /// Whether a beacon can be of the same clock: of equal speed, and not too far ahead.
  [[nodiscard]] bool canFollow(const Beacon& beacon, double wall) const;

 private:
  Options options_;
  double start_;  // by the wall
};
}  // namespace slamot::live
