#pragma once

#include <slamot/fusion/runTeam.h>
#include <slamot/live/TeamClock.h>

#include <functional>
#include <map>
#include <set>

namespace slamot::live
{
/// What both ways of running need to know.
struct LiveOptions
{
  std::set<int> team;                              ///< numbers of all, this robot's too
  std::uint64_t session = 1;                       ///< higher after each start of this robot
  core::RunOptions run;                            ///< progress, and when to stop
  std::function<void(const std::string&)> onNews;  ///< who comes and goes, a line each
  std::function<void(const fusion::FusionEvent&)> onFusion;  ///< each good message
};

/// Of a run by the wall's clock.
struct RealTimeOptions
{
  double speed = 1;               ///< of the log's clock against the wall's
  std::optional<double> startAt;  ///< when the team's clock begins, by wallTime(); absent: at once
  std::optional<double> clockZero;  ///< at what time in the log; absent: that of the first step
  double waitS = 0;                 ///< waits until all hear each other [s], at most
  double maxAge = 1;                ///< a robot so far behind its clock neither tells nor hears [s]
};

/// Of a run in lockstep.
struct LockstepOptions
{
  double waitS = 60;     ///< waits for the others to be there [s], at most
  double silenceS = 60;  ///< of one who is waited for, after which the run is given up [s]
};

/// How a live run ended, and who else was there.
struct LiveResult : core::RunResult
{
  std::map<int, int> sessionsHeard;  ///< starts of each other robot that were heard
};

/// Runs one robot by the wall's clock: each step when its time has come, and what others tell as
/// it comes.  A step goes to the sinks when the next one is due, with all that was fused until
/// then. \param radio through which what is heard goes, so that a poor one can be tried out. Errors
/// as core::run().
LiveResult runRealTime(fusion::TeamRobot& robot, fusion::Radio& radio, Network& network,
                       const LiveOptions& options, const RealTimeOptions& timing);

/// Runs one robot step by step with all others: the same logs give the same results as
/// fusion::runTeam().
/// Errors as core::run(), and kLimit when another is silent or ends before its log.
LiveResult runLockstep(fusion::TeamRobot& robot, fusion::Radio& radio, Network& network,
                       const LiveOptions& options, const LockstepOptions& limits);
}  // namespace slamot::live
