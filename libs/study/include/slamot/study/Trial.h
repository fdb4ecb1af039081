#pragma once

#include <slamot/core/run.h>
#include <slamot/eval/Evaluation.h>
#include <slamot/study/Metrics.h>
#include <slamot/study/Plan.h>
#include <slamot/team/Team.h>

#include <memory>

namespace slamot::study
{
/// One run, ready to go: where its steps come from, its truth, and the filter; or, where the method
/// has a section [team], all of this for each robot of the scenario.  Equal cell and seed give all
/// methods the same steps.
struct Trial
{
  struct Robot
  {
    std::unique_ptr<core::Source> source;
    std::function<const eval::Truth&()> truth;  ///< complete once the source is at its end
    core::Starts starts;
  };
  std::vector<Robot> robots;
  std::unique_ptr<core::Filter> filter;  ///< of the one robot; null in a team
  std::unique_ptr<team::Team> team;
  eval::EvaluationOptions evaluation;
  std::string effective;  ///< all that the result depends on, but seed and program
  /// Which simulated world it is, the same for all methods; and its bound, null without one, or
  /// where errors are taken otherwise than from the map's frame.
  std::string world;
  std::function<std::optional<BoundFigures>()> bound;
};

/// \throws core::Error: kConfig on a wrong scenario or method; else what is wrong with a rawlog.
[[nodiscard]] Trial openTrial(const StudySpec& spec, const Cell& cell, const Method& method,
                              std::uint64_t seed);

/// Runs it to its end, and takes its metrics: of a team the means over its robots.
/// \param bound of its world, if it is known
[[nodiscard]] std::vector<std::optional<double>> runTrial(
    Trial& trial, const std::optional<BoundFigures>& bound = {});
}  // namespace slamot::study
