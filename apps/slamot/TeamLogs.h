#pragma once

#include <slamot/eval/Truth.h>

#include <map>
#include <string>
#include <vector>

namespace slamot::apps
{
/// The logs of a team, X.robot<k>.rawlog, each with its truth in X.robot<k>.truth/: all or none.
class TeamLogs
{
 public:
  /// \param rawlog X.rawlog.  \throws core::Error as rawlogOutput(), and kUnreadable if there is no
  /// writing beside it.
  explicit TeamLogs(const std::string& rawlog);
  /// What was not placed is gone.
  ~TeamLogs();
  TeamLogs(const TeamLogs&) = delete;
  TeamLogs& operator=(const TeamLogs&) = delete;

  /// Where a robot's log will be.
  [[nodiscard]] std::string pathOf(int robot) const;
  /// Where it is to be written until then.
  [[nodiscard]] std::string partOf(int robot) const;
  /// Its log is written; this is its truth.
  void add(int robot, const eval::Truth& truth) { truths_[robot] = truth; }
  [[nodiscard]] const eval::Truth& truth(int robot) const { return truths_.at(robot); }
  /// Puts all logs that were added in their place.  \throws core::Error as results::saveTruth(),
  /// and kUnreadable if a log can't be put there; none of them is there then.
  void place();

 private:
  void placeAll(std::vector<std::string>& made) const;

  std::string stem_;    // X
  std::string folder_;  // of the parts
  std::map<int, eval::Truth> truths_;
};
}  // namespace slamot::apps
