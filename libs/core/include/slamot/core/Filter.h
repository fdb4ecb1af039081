#pragma once

#include <slamot/core/Estimate.h>
#include <slamot/core/Start.h>

#include <functional>

namespace slamot::core
{
/// An estimator: the only virtual call into it is process(), once a step.
class Filter
{
 public:
  virtual ~Filter() = default;

  /// Takes in one step and tells what is believed after it.
  /// \throws Error (kNonsense) if time goes backwards or a value is not finite; the filter is then
  /// as before the call.
  virtual Update process(const Step& step) = 0;

  /// What is believed now; before the first step, the start.
  [[nodiscard]] virtual Estimate estimate() const = 0;

  /// The pose samples of a particle filter; empty for others.
  [[nodiscard]] virtual std::vector<WeightedPose> particles() const { return {}; }

  /// The whole path as it is believed now, a pose for every step with odometry, by rising times: of
  /// the heaviest particle, or after later scans have closed loops.  Empty: the filter keeps none,
  /// and its estimates, one after another, are the path.
  [[nodiscard]] virtual std::vector<PathPose> path() const { return {}; }
};

/// What a filter is made with, besides its parameters.
struct FilterContext
{
  Starts starts;  ///< what is known of where robot and targets start, from the log or the config
  std::uint64_t seed = 1;  ///< fixes every random number that the filter draws
  int threads = 1;         ///< that it may use; no result may depend on how many
  /// The robot's true pose at a time, if known there: only for the bound `true-pose-target`, which
  /// says so by its name.  Empty for every other filter.
  std::function<std::optional<Pose2D>(double time)> truePose{};
};
}  // namespace slamot::core
