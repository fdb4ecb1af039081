#pragma once

#include "Driver.h"

#include <slamot/core/Start.h>
#include <slamot/math/gaussian.h>

namespace slamot::sim
{
/// The robot and its targets, as they truly move.
class Bodies
{
 public:
  Bodies(const Scenario& scenario, std::uint64_t seed);

  /// All by one step.  Returns what the robot knows of its own: the command, and the noise that
  /// driving adds to it.
  Gaussian<Pose2D> move();

  [[nodiscard]] double elapsed() const { return step_ * scenario_.dt; }  ///< since the start [s]
  [[nodiscard]] int step() const { return step_; }
  [[nodiscard]] const Pose2D& robot() const { return robot_.pose; }
  [[nodiscard]] std::map<int, Pose2D> presentTargets() const;

  /// What a filter is told, without the time.
  [[nodiscard]] core::Starts starts() const;

 private:
  struct Body
  {
    Pose2D pose;
    Driver driver;
  };
  [[nodiscard]] Command robotCommand();
  [[nodiscard]] Pose2D moved(const Pose2D& pose, const Command& c, const Motion& m,
                             std::uint64_t key) const;

  Scenario scenario_;
  std::uint64_t seed_;
  int step_ = 0;
  Body robot_;
  std::map<int, Body> targets_;
};
}  // namespace slamot::sim
