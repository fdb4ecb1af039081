#pragma once

#include <slamot/filters/EkfSlamot.h>
#include <slamot/fusion/runTeam.h>

namespace slamot::team
{
/// One robot's log.
struct Log
{
  int number = 0;                  ///< under which others see it and messages name it
  core::Source* source = nullptr;  ///< of its steps; never null
  core::Starts starts;             ///< where it and its targets start
};

/// A team made from a configuration: a filter for each robot, their messages and the radio; or,
/// with rule = centralized, one EKF for all.
class Team
{
 public:
  /// The filters are those of `methods` in [team], one a robot, or of the config's one method.
  /// \throws core::Error (kConfig) on a wrong configuration, a filter that can't be one of a team,
  /// or two robots of one number.
  Team(core::Config& config, const std::vector<Log>& logs, std::uint64_t seed, int threads);

  /// Runs all logs to their end; sinks by robot.  As fusion::runTeam().
  core::RunResult run(const std::vector<std::vector<core::Sink*>>& sinks,
                      const core::RunOptions& options = {});

  /// How many robots.
  [[nodiscard]] std::size_t size() const { return robots_.size(); }
  /// Section [team].
  [[nodiscard]] const fusion::TeamOptions& options() const { return options_; }
  /// The robot's estimator; with rule = centralized, its view of the one for all.
  [[nodiscard]] const core::Filter& filter(std::size_t robot) const { return *filters_[robot]; }
  /// Name of the robot's filter.
  [[nodiscard]] const std::string& method(std::size_t robot) const { return methods_[robot]; }
  /// Null with rule = centralized.
  [[nodiscard]] const fusion::Member* member(std::size_t robot) const
  {
    return robots_[robot].member;
  }
  /// The good messages that it took in, after run().
  [[nodiscard]] const std::vector<fusion::FusionEvent>& events(std::size_t robot) const
  {
    return robots_[robot].events;
  }

 private:
  void centralize(core::Config& config, const std::vector<core::FilterContext>& contexts,
                  const std::vector<Log>& logs);
  void gather(core::Config& config, const std::vector<core::FilterContext>& contexts,
              const std::vector<Log>& logs, const std::set<int>& numbers);

  fusion::TeamOptions options_;
  std::vector<std::string> methods_;
  std::unique_ptr<filters::CentralizedEkf> shared_;
  std::vector<std::unique_ptr<core::Filter>> filters_;
  std::vector<std::unique_ptr<fusion::Member>> members_;
  std::vector<fusion::TeamRobot> robots_;
  fusion::Radio radio_;
};

/// What the filter of the robot of this number is made from: the same in any team, and alone.
[[nodiscard]] core::FilterContext contextOf(const core::Starts& starts, int number,
                                            std::uint64_t seed, int threads);

/// A filter, and itself as one that can exchange estimates.
struct MemberFilter
{
  std::unique_ptr<core::Filter> filter;  ///< never null
  core::TeamFilter* asMember = nullptr;  ///< the same object
};
/// \throws core::Error (kConfig) on a wrong configuration, or a filter that can't exchange.
[[nodiscard]] MemberFilter makeFilter(core::Config& config, const std::string& method,
                                      const core::FilterContext& context);

/// The methods of a team's robots, as the configuration names them.
/// \throws core::Error (kConfig) if it names neither one nor as many as there are robots.
[[nodiscard]] std::vector<std::string> methodsOf(core::Config& config, std::size_t robots);

/// The method of a team's robot that runs alone: that of [run], else the one of all in [team].
/// \throws core::Error (kConfig) if there are several.
[[nodiscard]] std::string methodAlone(core::Config& config);
}  // namespace slamot::team
