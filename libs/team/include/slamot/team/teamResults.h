#pragma once

#include <slamot/results/Figures.h>
#include <slamot/results/Summary.h>
#include <slamot/team/Team.h>

namespace slamot::team
{
/// The number at the end of a robot's name (`X.robot<number>`), if it has one.
[[nodiscard]] std::optional<int> numberIn(const std::string& name);

/// The number of each robot: that at the end of its name (`X.robot<number>`) where all have one,
/// else its place.
[[nodiscard]] std::vector<int> robotNumbers(const std::vector<std::string>& names);

/// One robot's run, all evaluated with one common alignment.
struct RobotResult
{
  std::string name;       ///< of its log, without the ending
  results::RunView view;  ///< its record, truth and evaluation
};

/// What fusion came to for one robot.
struct FusionSummary
{
  std::int64_t fused = 0;       ///< messages that made the estimate better
  std::int64_t candidates = 0;  ///< of these, with a sighting of this robot
  /// Candidates taken that were not this robot: more than five of the sensor's deviations from
  /// where it truly was, seen from where the sender truly was; none without truth.
  std::optional<std::int64_t> wrongCandidates;
};
/// \param truths of all robots by their number
[[nodiscard]] FusionSummary summarise(const std::vector<fusion::FusionEvent>& events,
                                      const eval::Truth& own,
                                      const std::map<int, const eval::Truth*>& truths);

/// The same for each robot of a team.
[[nodiscard]] std::vector<FusionSummary> fusionsOf(const Team& team,
                                                   const std::vector<RobotResult>& robots);

/// team.json: errors, consistency and messages by outcome, for each robot and on the mean.
[[nodiscard]] std::string teamJson(const Team& team, const std::vector<RobotResult>& robots,
                                   std::uint64_t seed, const results::Timing& timing);

/// The same for a person.
[[nodiscard]] std::string teamTable(const Team& team, const std::vector<RobotResult>& robots);

/// fusions.csv: one row for each message that was good, with what it changed.
void writeFusions(const std::string& path, const std::vector<fusion::FusionEvent>& events);
}  // namespace slamot::team
