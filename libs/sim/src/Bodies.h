#pragma once

#include "AcceleratedPoint.h"
#include "Driver.h"

#include <slamot/core/Start.h>
#include <slamot/math/gaussian.h>

namespace slamot::sim
{
/// The robots and their targets, as they truly move.
class Bodies
{
 public:
  Bodies(const Scenario& scenario, std::uint64_t seed);

  /// All by one step.  Returns what each robot knows of its own: the command, and the noise that
  /// driving adds to it.
  std::vector<Gaussian<Pose2D>> move();

  [[nodiscard]] double elapsed() const { return step_ * scenario_.dt; }  ///< since the start [s]
  [[nodiscard]] int step() const { return step_; }
  [[nodiscard]] const Pose2D& robot(int index) const { return robots_[std::size_t(index)].pose; }
  [[nodiscard]] std::map<int, Pose2D> presentTargets() const;
  /// All robots but this one, by their index.
  [[nodiscard]] std::map<int, Point2D> matesOf(int robot) const;

  /// What a robot's filter is told, without the time.
  [[nodiscard]] core::Starts starts(int robot) const;

 private:
  struct Body
  {
    Pose2D pose;
    Driver driver;
    std::optional<AcceleratedPoint> point;  // moves by itself instead of being driven
  };
  [[nodiscard]] Body makeBody(const Motion& motion, const Pose2D& pose, std::uint64_t key) const;
  [[nodiscard]] Command robotCommand(std::size_t robot);
  void drive(Body& body, const Command& c, const Motion& m, std::uint64_t key) const;
  void moveTarget(Body& body, const Motion& m, std::uint64_t key) const;

  Scenario scenario_;
  std::uint64_t seed_;
  int step_ = 0;
  std::vector<Body> robots_;
  std::map<int, Body> targets_;
};
}  // namespace slamot::sim
