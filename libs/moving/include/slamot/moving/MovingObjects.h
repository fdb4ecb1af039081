#pragma once

#include <slamot/core/Estimate.h>
#include <slamot/core/Start.h>
#include <slamot/core/Step.h>
#include <slamot/moving/MovingOptions.h>

#include <memory>
#include <vector>

namespace slamot::moving
{
/// Follows what moves by laser alone.  Every small thing in a scan is a candidate; one is believed
/// to move once it has gone some way and its returns lie where beams passed before.  From then on
/// it is a rectangle that drives (or a point, by Shape::kCentre).
///
/// All is kept in axes that the robot's increments add up to, in which its pose is exact: what a
/// laser tells is relative to the robot, and a loop that is closed moves no target.
class MovingObjects
{
 public:
  /// \param starts where the robot and its targets start, if known; such a target is followed from
  /// its first sighting on, by its identity.
  explicit MovingObjects(const MovingOptions& options, const core::Starts& starts = {});
  ~MovingObjects();
  /// What was moved from may only be assigned to or destroyed.
  MovingObjects(MovingObjects&&) noexcept;
  /// As the constructor.
  MovingObjects& operator=(MovingObjects&&) noexcept;

  /// The robot moves by an increment, in its frame, over dt [s]; things move meanwhile.
  void move(const Gaussian<Pose2D>& increment, double dt);
  /// \returns by beam, whether it met something that moves.
  std::vector<bool> see(double time, const core::LaserScan& scan);
  /// By beam, whether it meets, or passes just beside, what is known to move, as predicted.
  [[nodiscard]] std::vector<bool> expected(const core::LaserScan& scan) const;
  /// What is believed to move, in map axes, given where the robot is there.
  [[nodiscard]] std::vector<core::TargetEstimate> targets(const Gaussian<Pose2D>& robot) const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};
}  // namespace slamot::moving
