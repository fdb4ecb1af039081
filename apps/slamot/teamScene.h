#pragma once

#include <slamot/mrpt/Scene.h>
#include <slamot/team/teamFigures.h>

namespace slamot::apps
{
/// One robot's map, and whether its sensor tells landmarks apart.
struct TeamLandmarks
{
  std::vector<core::LandmarkEstimate> landmarks;
  bool identified = false;
};
/// The landmarks of all robots; of those with identities, the surest of each.
[[nodiscard]] std::vector<core::LandmarkEstimate> landmarksOfAll(
    const std::vector<TeamLandmarks>& maps);

/// A team's run as what saveScene() draws: paths of all robots, the target as each tracks it, a few
/// fusions of each, and the landmarks of all; of landmarks with identities, the surest of each.
[[nodiscard]] mrpt::SceneData teamSceneOf(const std::string& title, const team::TeamView& team);
}  // namespace slamot::apps
