#include "sceneLegend.h"

#include "Legend.h"
#include "palette.h"

#include <algorithm>

namespace slamot::mrpt
{
namespace
{
constexpr std::size_t kNamedTargets = 6;  // more do not fit the legend

void addTeam(Legend& legend, const SceneData& data)
{
  for (std::size_t i = 0; i < std::min(data.team.size(), kNamedTargets); ++i)
    legend.line(data.team[i].robot.name, teamColour(i));
  if (data.team.empty()) return;
  legend.thinLine("target, by each", kTeam[0]);
  const bool any = std::any_of(data.team.begin(), data.team.end(),
                               [](const SceneMember& m) { return !m.fusions.empty(); });
  if (any)
    legend.ellipse("fusions, " + std::to_string(std::lround(data.fusionScale)) + ":1", kTeam[0]);
}

bool hasTruePaths(const SceneData& data)
{
  return !data.robot.truth.empty() ||
         std::any_of(data.team.begin(), data.team.end(),
                     [](const SceneMember& m) { return !m.robot.truth.empty(); });
}
}  // namespace

void addLegend(MrptScene& scene, const SceneData& data, const SceneFrame& frame)
{
  Legend legend(scene, data.title);
  // Of a run whose moments are drawn, maps and particles are known at its end only.
  const std::string end = data.ofMoments ? " at the end" : "";
  if (data.team.empty()) legend.line(data.robot.name, kRobot);
  addTeam(legend, data);
  for (std::size_t i = 0; i < std::min(data.targets.size(), kNamedTargets); ++i)
    legend.line(data.targets[i].name, targetColour(i));
  if (hasTruePaths(data)) legend.thinLine("true paths", kTruth);
  if (!data.landmarks.empty())
    legend.ellipse(data.ofMoments ? "map at the end, 95%" : "landmarks, 95%", kLandmark);
  if (!data.trueLandmarks.empty()) legend.cross("true landmarks", kTruth);
  if (!data.sightings.empty()) legend.thinLine("sightings", kSighting);
  if (!data.scanPoints.empty()) legend.dots("laser scan", kScan);
  if (!data.laserPoints.empty()) legend.dots("laser points", kLaser);
  if (!data.particles.empty()) legend.dots("particles" + end, kParticle);
  legend.thinLine("grid of " + frame.gridText(), kFaint);
  legend.finish();
}
}  // namespace slamot::mrpt
