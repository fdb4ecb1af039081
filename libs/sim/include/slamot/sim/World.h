#pragma once

#include <slamot/core/Start.h>
#include <slamot/core/run.h>
#include <slamot/eval/Truth.h>
#include <slamot/sim/Scenario.h>

#include <memory>

namespace slamot::sim
{
/// Runs a scenario: the steps that its robot reports, with the truth beside them.  Equal scenario
/// and seed give equal steps.
class World : public core::Source
{
 public:
  enum class Sightings
  {
    kAsRead,  ///< as a reader delivers them: out of the field of view is dropped and counted
    kRaw      ///< as a sensor puts them out, to be written to a log
  };

  /// \throws core::Error (kConfig) if the scenario leaves no place for an object.
  World(const Scenario& scenario, std::uint64_t seed, Sightings sightings = Sightings::kAsRead);
  ~World() override;

  std::optional<core::Step> next() override;
  [[nodiscard]] double progress() const override;

  /// What a filter may know of the starts, in the map frame.
  [[nodiscard]] const core::Starts& starts() const;
  /// From the start to the last step delivered.  A target has poses while it is present only;
  /// associations count a step's sightings as a reader delivers them.
  [[nodiscard]] const eval::Truth& truth() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};
}  // namespace slamot::sim
