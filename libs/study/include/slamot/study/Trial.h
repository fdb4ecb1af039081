#pragma once

#include <slamot/core/run.h>
#include <slamot/eval/Evaluation.h>
#include <slamot/study/ErrorCurves.h>
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
  /// One robot's data.
  struct Robot
  {
    std::unique_ptr<core::Source> source;       ///< its steps
    std::function<const eval::Truth&()> truth;  ///< complete once the source is at its end
    core::Starts starts;                        ///< what the filter may know of the starts
  };
  std::vector<Robot> robots;             ///< one, or those of a team
  std::unique_ptr<core::Filter> filter;  ///< of the one robot; null in a team
  std::unique_ptr<team::Team> team;      ///< null: it is no team
  eval::EvaluationOptions evaluation;    ///< how errors are to be taken
  int timeBins = 0;                      ///< of ErrorCurves; 0: none are kept
  std::string effective;                 ///< all that the result depends on, but seed and program
  /// Which simulated world it is, the same for all methods; and its bound, null without one, or
  /// where errors are taken otherwise than from the map's frame.
  std::string world;
  std::function<std::optional<BoundFigures>()>
      bound;  ///< computes it, which may take seconds; see `world`
};

/// \throws core::Error: kConfig on a wrong scenario or method; else what is wrong with a rawlog.
[[nodiscard]] Trial openTrial(const StudySpec& spec, const Cell& cell, const Method& method,
                              std::uint64_t seed);

/// What became of each robot of a trial; refers to the trial, which must outlive it.
struct FinishedTrial
{
  std::vector<eval::Record> records;          ///< by robot
  std::vector<const eval::Truth*> truths;     ///< by robot, of the trial's sources
  std::vector<eval::Evaluation> evaluations;  ///< by robot; a team's all with one alignment

  /// Records with their truths, as alignment() takes them; must not outlive this.
  [[nodiscard]] std::vector<eval::RunWithTruth> runs() const;
};

/// Runs it to its end.  \param keepLasers whether records are to hold laser scans
[[nodiscard]] FinishedTrial finish(Trial& trial, bool keepLasers = false);

/// A trial in numbers: of a team the means over its robots.
struct TrialResult
{
  std::vector<std::optional<double>> metrics;  ///< in the order of metrics()
  ErrorCurves curves;                          ///< none unless the study keeps them
};

/// Runs it to its end, and takes its numbers.
/// \param bound of its world, if it is known
[[nodiscard]] TrialResult runTrial(Trial& trial, const std::optional<BoundFigures>& bound = {});
}  // namespace slamot::study
