#pragma once

#include <slamot/core/run.h>
#include <slamot/fusion/Member.h>

namespace slamot::fusion
{
/// What a team's run needs of one robot.  Without a member it exchanges nothing.
struct TeamRobot
{
  core::Source* source = nullptr;   ///< its log; never null
  core::Filter* filter = nullptr;   ///< its estimator; never null
  Member* member = nullptr;         ///< its part in the exchange; null: none
  std::vector<core::Sink*> sinks;   ///< where its steps and what it believes go
  std::vector<FusionEvent> events;  ///< filled by the run
  /// If set, gets every step of an instant before any filter does: where robots share a filter that
  /// relates them, all must have moved before one looks.
  std::function<void(const core::Step&)> move{};
};

/// Replays several logs on one clock: the robots that have a step at the earliest time take it in,
/// then those whose turn it is send, and then every one of them takes in what has reached it; what
/// it believes then goes to its sinks.  A message is made before any of its instant is taken in.
/// Errors as core::run().
core::RunResult runTeam(std::vector<TeamRobot>& robots, Radio& radio,
                        const core::RunOptions& options = {});
}  // namespace slamot::fusion
