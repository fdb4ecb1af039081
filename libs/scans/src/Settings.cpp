#include <slamot/scans/Settings.h>

namespace slamot::scans
{
namespace
{
MatchReach reachFrom(core::Params& p, const std::string& prefix, const MatchReach& d)
{
  MatchReach r;
  r.leastRadius = p.inRange(prefix + "least_m", 0, 10, d.leastRadius);
  r.mostRadius = p.inRange(prefix + "most_m", 0.05, 20, d.mostRadius);
  r.leastTurn = p.inRange(prefix + "least_deg", 0, 180, d.leastTurn);
  r.mostTurn = p.inRange(prefix + "most_deg", 1, 180, d.mostTurn);
  if (r.leastRadius > r.mostRadius) p.fail(prefix + "least_m", "is above " + prefix + "most_m");
  if (r.leastTurn > r.mostTurn) p.fail(prefix + "least_deg", "is above " + prefix + "most_deg");
  return r;
}

LoopSettings loopFrom(core::Params& p)
{
  LoopSettings s;
  s.search = p.flag("loops", true);
  s.near = p.inRange("loop_near_m", 0.1, 50, 4);
  s.stretch = p.inRange("loop_stretch_m", 0.1, 50, 3);
  s.tries = p.integer("loop_tries", 1, 100, 4);
  s.reach = reachFrom(p, "loop_search_", {0.3, 6, math::degToRad(5), math::degToRad(45)});
  s.leastScore = p.inRange("loop_score", 0, 1, 0.55);
  s.sureRadius = p.inRange("loop_sure_m", 0, 20, 1);
  s.votes = p.integer("loop_votes", 1, 20, 3);
  s.voteStretch = p.inRange("loop_vote_stretch_m", 0.1, 100, 6);
  return s;
}
}  // namespace

Settings Settings::from(core::Params& p)
{
  Settings s;
  s.maxRange = p.inRange("max_range_m", 1, 100, 30);
  s.thinning = p.inRange("thinning_m", 0.01, 1, 0.05);
  s.odometryScale = p.inRange("odometry_scale", 0.01, 100, 1);
  s.blindSpeed = p.inRange("blind_speed_mps", 0, 100, 0.5);
  s.blindTurn = p.inRange("blind_turn_degps", 0, 360, math::degToRad(20));
  s.keyframeDistance = p.inRange("keyframe_m", 0.01, 10, 0.5);
  s.keyframeTurn = p.inRange("keyframe_deg", 0.1, 180, math::degToRad(28));
  s.recent = p.inRange("recent_m", 0.1, 100, 12);
  s.reach = reachFrom(p, "search_", {0.4, 1.5, math::degToRad(25), math::degToRad(60)});
  s.match.rangeStd = p.inRange("range_std_m", 1e-3, 1, 0.03);
  s.match.inflation = p.inRange("match_inflation", 1e-3, 1e3, 1);
  s.match.floorPosition = p.inRange("match_floor_m", 0, 10, 0.01);
  s.match.floorHeading = p.inRange("match_floor_deg", 0, 90, math::degToRad(0.2));
  s.match.leastScore = p.inRange("match_score", 0, 1, 0.35);
  s.loop = loopFrom(p);
  return s;
}
}  // namespace slamot::scans
