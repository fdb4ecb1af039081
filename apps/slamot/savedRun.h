#pragma once

#include <slamot/eval/Evaluation.h>
#include <slamot/mrpt/Scene.h>
#include <slamot/results/Figures.h>

#include <optional>

namespace slamot::apps
{
/// The truth that a result goes with: PREFIX may be the folder of truth, the log it goes with, or
/// one trajectory of the robot; empty: the log that the result names.  None where it names no log.
/// \throws core::Error on malformed files.
[[nodiscard]] std::optional<eval::Truth> findTruth(const std::string& result, std::string prefix);
[[nodiscard]] bool isEmpty(const eval::Truth& truth);

/// How a result's run was evaluated: its config's alignment and lever arm; without one, first-pose.
[[nodiscard]] eval::EvaluationOptions savedOptions(const std::string& folder);

/// A result folder, read back, as far as it is there.
struct SavedRun
{
  std::string title;
  eval::Record record;  ///< its laser scans from map.simplemap
  eval::Truth truth;    ///< empty where none is found
  eval::Evaluation evaluation;
  std::vector<core::WeightedPose> particles;  ///< at the end, from the scene; of equal weight

  [[nodiscard]] results::RunView view() const { return {record, truth, evaluation}; }
};

/// \param truth PREFIX as of findTruth().
/// \throws core::Error where the folder holds no path of a robot, or is of a team.
[[nodiscard]] SavedRun loadSavedRun(const std::string& folder, const std::string& truth);

/// A team's result folder, read back.
struct SavedTeam
{
  std::string title;
  std::vector<std::string> names;  ///< of the robots
  std::vector<SavedRun> runs;      ///< of each, all with one alignment
};

/// \throws core::Error where the folder is no team's, or a robot's in it can't be used.
[[nodiscard]] SavedTeam loadSavedTeam(const std::string& folder);
}  // namespace slamot::apps
