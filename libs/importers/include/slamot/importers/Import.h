#pragma once

#include <slamot/core/Start.h>
#include <slamot/core/run.h>
#include <slamot/eval/Truth.h>

namespace slamot::importers
{
/// What an import delivered and what it left out.
struct Counts
{
  std::size_t steps = 0;          ///< delivered
  std::size_t landmarkScans = 0;  ///< also those that saw nothing
  std::size_t sightings = 0;      ///< of landmarks, in these scans
  std::size_t blobScans = 0;      ///< also those that saw nothing
  std::size_t blobs = 0;          ///< in these scans
  std::size_t lasers = 0;         ///< laser scans
  std::size_t outOfView = 0;      ///< dropped: range at or below zero, or out of the field of view
  std::size_t outOfTime = 0;      ///< dropped: where no odometry tells how the robot moved
  std::size_t unknown = 0;        ///< dropped: of a thing that the data's own tables don't hold
  std::size_t hidden = 0;         ///< dropped: as asked for
  double start = 0;               ///< time of the first step [s]
  double end = 0;                 ///< time of the last step so far [s]
};

/// Data of another format as a stream of steps, with its starts and its truth.
/// Reading fails with core::Error: file, line, what is wrong and how to mend it.
class Import : public core::Source
{
 public:
  /// What the data tell of where robot and targets start; known before the first step.
  [[nodiscard]] virtual const core::Starts& starts() const = 0;
  /// Complete once next() has delivered the last step.
  [[nodiscard]] virtual const eval::Truth& truth() const = 0;
  /// Of what next() has delivered so far.
  [[nodiscard]] const Counts& counts() const { return counts_; }
  /// What looks wrong though it has a meaning, one sentence each; complete after the last step.
  [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }

 protected:
  /// Counts a step that next() is about to deliver.
  core::Step deliver(core::Step step);

  Counts counts_;                      ///< what counts() tells; formats add what they leave out
  std::vector<std::string> warnings_;  ///< what warnings() tells
};
}  // namespace slamot::importers
