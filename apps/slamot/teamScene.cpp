#include "teamScene.h"

#include <algorithm>
#include <map>

#include "sceneOf.h"

namespace slamot::apps
{
namespace
{
mrpt::SceneMember memberOf(const team::TeamView& team, std::size_t r, mrpt::SceneData scene)
{
  const auto& robot = team.robots[r];
  mrpt::SceneMember out;
  out.robot = std::move(scene.robot);
  out.robot.name = robot.name;
  const std::string target = team::targetOf(robot, team.target).name;
  for (mrpt::SceneTrack& t : scene.targets)
    if (t.name == target) out.target = std::move(t);
  out.target.name = robot.name + " target";
  for (const fusion::FusionEvent& e : team::someFusions(team, r))
  {
    out.fusions.push_back({e.robotBefore, e.robotAfter});
    if (e.hasTarget) out.fusions.push_back({e.targetBefore, e.targetAfter});
  }
  return out;
}
}  // namespace

std::vector<core::LandmarkEstimate> landmarksOfAll(const std::vector<TeamLandmarks>& maps)
{
  std::vector<core::LandmarkEstimate> out;
  std::map<int, core::LandmarkEstimate> surest;
  for (const TeamLandmarks& map : maps)
    for (const core::LandmarkEstimate& l : map.landmarks)
    {
      if (!map.identified)
      {
        out.push_back(l);
        continue;
      }
      const auto [it, isNew] = surest.emplace(l.id, l);
      if (!isNew && l.position.cov.trace() < it->second.position.cov.trace()) it->second = l;
    }
  for (const auto& [id, l] : surest) out.push_back(l);
  return out;
}

mrpt::SceneData teamSceneOf(const std::string& title, const team::TeamView& team)
{
  mrpt::SceneData out;
  out.title = title;
  std::vector<TeamLandmarks> maps;
  for (const auto& robot : team.robots)
    maps.push_back({robot.run.record.landmarks, robot.run.record.landmarksIdentified()});
  out.landmarks = landmarksOfAll(maps);
  out.fusionScale = team::ellipseScale(team);
  bool hasTargetTruth = false;
  for (std::size_t r = 0; r < team.robots.size(); ++r)
  {
    mrpt::SceneData one = sceneOf("", team.robots[r].run, {});
    if (out.trueLandmarks.empty()) out.trueLandmarks = std::move(one.trueLandmarks);
    out.laserPoints.insert(out.laserPoints.end(), one.laserPoints.begin(), one.laserPoints.end());
    mrpt::SceneMember member = memberOf(team, r, std::move(one));
    if (hasTargetTruth) member.target.truth.clear();  // it is the same for all
    hasTargetTruth = hasTargetTruth || !member.target.truth.empty();
    out.team.push_back(std::move(member));
  }
  return out;
}
}  // namespace slamot::apps
