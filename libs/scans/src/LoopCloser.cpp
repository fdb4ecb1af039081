#include "LoopCloser.h"

#include <slamot/scans/returns.h>

#include <algorithm>

#include "reach.h"

namespace slamot::scans
{
namespace
{
MatchSettings strict(const Settings& settings)
{
  MatchSettings s = settings.match;
  s.leastScore = settings.loop.leastScore;
  return s;
}
}  // namespace

LoopCloser::LoopCloser(const Settings& settings)
    : settings_(settings.loop),
      recent_(settings.recent),
      maxRange_(settings.maxRange),
      thinning_(2 * settings.thinning),
      matcher_(strict(settings)),
      votes_(static_cast<std::size_t>(settings.loop.votes))
{
}

/// Stretches of the path that come near the newest keyframe, the nearest ones first.
std::vector<LoopCloser::Place> LoopCloser::places(const PoseGraph& graph,
                                                  const Keyframes& keyframes) const
{
  const std::size_t newest = keyframes.size() - 1;
  const std::vector<Gaussian<Pose2D>> reach = reachFrom(graph, newest);
  std::vector<Place> out;
  bool near = false;
  for (std::size_t i = 0; i < newest; ++i)
  {
    if (keyframes[newest].path - keyframes[i].path < recent_ + settings_.stretch) break;
    const double std = math::ellipse(reach[i].cov.topLeftCorner<2, 2>()).longer;
    const double distance = std::hypot(reach[i].mean.x, reach[i].mean.y);
    const bool was = near;
    near = !keyframes[i].points.empty() &&
           distance < settings_.near + std::min(3 * std, settings_.reach.mostRadius);
    if (!near) continue;
    if (!was)
      out.push_back({i, distance, inverse(reach[i])});
    else if (distance < out.back().distance)
      out.back() = {i, distance, inverse(reach[i])};
  }
  std::stable_sort(out.begin(), out.end(),
                   [](const Place& a, const Place& b) { return a.distance < b.distance; });
  if (out.size() > static_cast<std::size_t>(settings_.tries))
    out.resize(static_cast<std::size_t>(settings_.tries));
  return out;
}

bool LoopCloser::isSure(const Place& place) const
{
  const double std = math::ellipse(place.pose.cov.topLeftCorner<2, 2>()).longer;
  return 3 * std <= settings_.sureRadius;
}

std::vector<Relation> LoopCloser::search(const PoseGraph& graph, const Keyframes& keyframes)
{
  std::vector<Relation> out;
  const std::size_t newest = keyframes.size() - 1;
  const double path = keyframes[newest].path;
  votes_.forgetBefore(path - settings_.voteStretch);
  const std::vector<Place> found = places(graph, keyframes);
  if (found.empty()) return out;
  const auto [first, last] = around(keyframes, newest, settings_.stretch);
  const auto points =
      thinned(pointsOf(keyframes, graph, first, last, graph.pose(newest)), thinning_);
  for (const Place& place : found)
  {
    const auto [from, to] = around(keyframes, place.node, settings_.stretch);
    const LocalMap map(pointsOf(keyframes, graph, from, to, graph.pose(place.node)),
                       maxRange_ + settings_.reach.mostRadius);
    const Match match = matcher_.match(map, points, place.pose, settings_.reach);
    if (!match.matched) continue;
    const Relation loop{place.node, newest, match.alone, true};
    if (isSure(place))
      out.push_back(loop);
    else
      for (const Relation& r : votes_.add(graph, loop, path)) out.push_back(r);
  }
  return out;
}
}  // namespace slamot::scans
