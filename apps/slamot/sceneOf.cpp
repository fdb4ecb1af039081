#include "sceneOf.h"

#include <slamot/mrpt/scanPoints.h>

#include <cmath>
#include <limits>

namespace slamot::apps
{
namespace
{
/// What of a run is drawn: up to a row, and truth in the map's frame up to a time [s].
struct Part
{
  const results::RunView& run;
  std::size_t lastRow;
  double end;
  Pose2D mapFromTruth;
};

Part partOf(const results::RunView& run, std::size_t lastRow)
{
  const auto& rows = run.record.rows;
  const bool whole = lastRow + 1 >= rows.size();
  return {run, lastRow, whole ? std::numeric_limits<double>::infinity() : rows[lastRow].time,
          math::between(run.evaluation.truthFromMap, Pose2D{})};
}

/// Appends true paths, moved into the map's frame; in pieces where nothing is known for a while.
void appendTruth(std::vector<mrpt::Polyline>& pieces, const Part& part,
                 const eval::Trajectory& trajectory)
{
  const double gap = eval::EvaluationOptions{}.maxTruthGap;
  for (std::size_t i = 0; i < trajectory.poses.size(); ++i)
  {
    const auto& p = trajectory.poses[i];
    if (p.time > part.end) break;
    if (i == 0 || p.time - trajectory.poses[i - 1].time > gap) pieces.emplace_back();
    pieces.back().push_back(math::transform(part.mapFromTruth, {p.pose.x, p.pose.y}));
  }
}

mrpt::SceneTrack robotOf(const Part& part)
{
  const auto& rows = part.run.record.rows;
  mrpt::SceneTrack track;
  track.name = "robot";
  track.path.emplace_back();
  for (std::size_t i = 0; i < rows.size() && i <= part.lastRow; ++i)
    track.path.back().push_back({rows[i].robot.mean.x, rows[i].robot.mean.y});
  if (!rows.empty()) track.now = rows[std::min(part.lastRow, rows.size() - 1)].robot;
  appendTruth(track.truth, part, part.run.truth.robot);
  return track;
}

/// Appends a track's pieces, and its end if it is followed to the last row.
void append(mrpt::SceneTrack& out, const eval::TargetTrack& target, std::size_t lastRow)
{
  for (std::size_t i = 0; i < target.rows.size(); ++i)
  {
    const auto& row = target.rows[i];
    if (row.row > lastRow) break;
    if (row.row == lastRow) out.now = row.pose;
    if (i == 0 || row.row != target.rows[i - 1].row + 1) out.path.emplace_back();
    out.path.back().push_back({row.pose.mean.x, row.pose.mean.y});
  }
}

/// All tracks of a true target with its true path; that of one never tracked goes to the robot's.
void addTargets(mrpt::SceneData& scene, const Part& part)
{
  const results::RunView& run = part.run;
  for (const auto& group : results::targetGroups(run.record, run.evaluation))
  {
    mrpt::SceneTrack track;
    track.name = group.name;
    for (const std::size_t i : group.tracks) append(track, run.record.targets[i], part.lastRow);
    auto& truth = group.tracks.empty() ? scene.robot.truth : track.truth;
    if (group.truthId) appendTruth(truth, part, run.truth.targets.at(*group.truthId));
    if (!group.tracks.empty()) scene.targets.push_back(std::move(track));
  }
}

}  // namespace

mrpt::SceneData sceneUntil(const std::string& title, const results::RunView& run,
                           std::size_t lastRow)
{
  const Part part = partOf(run, lastRow);
  mrpt::SceneData scene;
  scene.title = title;
  scene.robot = robotOf(part);
  addTargets(scene, part);
  for (const auto& [id, p] : run.truth.landmarks)
    scene.trueLandmarks.push_back(math::transform(part.mapFromTruth, p));
  return scene;
}

mrpt::SceneData sceneOf(const std::string& title, const results::RunView& run,
                        std::vector<core::WeightedPose> particles)
{
  const auto& rows = run.record.rows;
  mrpt::SceneData scene = sceneUntil(title, run, rows.empty() ? 0 : rows.size() - 1);
  scene.landmarks = run.record.landmarks;
  for (const auto& laser : run.record.lasers)
    mrpt::appendPoints(scene.laserPoints, *laser.scan, rows[laser.row].robot.mean);
  scene.particles = std::move(particles);
  return scene;
}
}  // namespace slamot::apps
