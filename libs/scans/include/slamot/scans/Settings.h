#pragma once

#include <slamot/core/Params.h>
#include <slamot/scans/ScanMatcher.h>

namespace slamot::scans
{
/// Which old places are looked at for a loop, and what is believed of a match there.
struct LoopSettings
{
  bool search;         ///< whether loops are looked for at all
  double near;         ///< [m]: a place this far off, by the graph, may be one
  double stretch;      ///< [m] of path about a place, and behind the robot, that are matched
  int tries;           ///< places looked at for one keyframe
  MatchReach reach;    ///< how far around the expected place
  double leastScore;   ///< mean likelihood of points, 0 to 1
  double sureRadius;   ///< [m]: a search this wide needs votes
  int votes;           ///< loops that must agree
  double voteStretch;  ///< [m] of path within which they must come
};

/// The keys of section [scan-slam].
struct Settings
{
  double maxRange;          ///< [m]: a longer range tells nothing
  double thinning;          ///< [m]: of scans before they are matched or kept
  double odometryScale;     ///< of the log's deviations
  double blindSpeed;        ///< [m/s]: deviation of the motion over time without odometry
  double blindTurn;         ///< [rad/s]
  double keyframeDistance;  ///< [m] from the last scan kept to the next
  double keyframeTurn;      ///< [rad] likewise
  double recent;            ///< [m] of path that a new scan is matched with
  MatchReach reach;         ///< of a scan with the last stretch of path
  MatchSettings match;      ///< what a match is worth
  LoopSettings loop;        ///< old places

  /// \throws core::Error (kConfig); the keys are commented in config-ini/scan-slam.ini.
  static Settings from(core::Params& p);
};
}  // namespace slamot::scans
