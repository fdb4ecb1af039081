#pragma once

#include <slamot/core/Start.h>
#include <slamot/core/run.h>
#include <slamot/eval/Truth.h>
#include <slamot/sim/Scenario.h>

#include <memory>

namespace slamot::sim
{
/// Runs a scenario: the steps that one of its robots reports, with the truth beside them.  Equal
/// scenario and seed give equal steps.  Worlds of the same scenario and seed for several robots
/// are one world: the same landmarks, targets and clock, and each sees the others where they are.
class World : public core::Source
{
 public:
  /// Which of its sightings a world delivers.
  enum class Sightings
  {
    kAsRead,  ///< as a reader delivers them: out of the field of view is dropped and counted
    kRaw      ///< as a sensor puts them out, to be written to a log
  };

  /// \param robot its index.
  /// \throws core::Error (kConfig) if the scenario leaves no place for an object, or has no such
  /// robot.
  World(const Scenario& scenario, std::uint64_t seed, Sightings sightings = Sightings::kAsRead,
        int robot = 0);
  ~World() override;

  std::optional<core::Step> next() override;
  /// What the robot's camera saw at the last step; none without one, or where it looked elsewhen.
  [[nodiscard]] std::optional<Picture> picture() const;
  [[nodiscard]] double progress() const override;

  /// What a filter may know of the starts, in the map frame.
  [[nodiscard]] const core::Starts& starts() const;
  /// From the start to the last step delivered; of this robot, without its mates.  A target has
  /// poses while it is present only; associations count a step's sightings as a reader delivers
  /// them.
  [[nodiscard]] const eval::Truth& truth() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};
}  // namespace slamot::sim
