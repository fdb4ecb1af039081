#include "sceneOf.h"

#include <cmath>

namespace slamot::apps
{
namespace
{
/// Appends true paths, moved into another frame; in pieces where nothing is known for a while.
void appendTruth(std::vector<mrpt::Polyline>& pieces, const Pose2D& frame,
                 const eval::Trajectory& trajectory)
{
  const double gap = eval::EvaluationOptions{}.maxTruthGap;
  for (std::size_t i = 0; i < trajectory.poses.size(); ++i)
  {
    const auto& p = trajectory.poses[i];
    if (i == 0 || p.time - trajectory.poses[i - 1].time > gap) pieces.emplace_back();
    pieces.back().push_back(math::transform(frame, {p.pose.x, p.pose.y}));
  }
}

mrpt::SceneTrack robotOf(const results::RunView& run, const Pose2D& mapFromTruth)
{
  mrpt::SceneTrack track;
  track.name = "robot";
  track.path.emplace_back();
  for (const auto& row : run.record.rows)
    track.path.back().push_back({row.robot.mean.x, row.robot.mean.y});
  if (!run.record.rows.empty()) track.now = run.record.rows.back().robot;
  appendTruth(track.truth, mapFromTruth, run.truth.robot);
  return track;
}

mrpt::SceneTrack targetOf(const eval::TargetTrack& target, std::size_t rowsOfRun)
{
  mrpt::SceneTrack track;
  track.name = results::nameOf(target);
  for (std::size_t i = 0; i < target.rows.size(); ++i)
  {
    const auto& row = target.rows[i];
    if (i == 0 || row.row != target.rows[i - 1].row + 1) track.path.emplace_back();
    track.path.back().push_back({row.pose.mean.x, row.pose.mean.y});
  }
  if (!target.rows.empty() && target.rows.back().row + 1 == rowsOfRun)
    track.now = target.rows.back().pose;
  return track;
}

/// True paths go to the first track that stands for them; those of no track to the robot's.
void addTrueTargets(mrpt::SceneData& scene, const results::RunView& run, const Pose2D& mapFromTruth)
{
  const auto& tracks = run.evaluation.targets;
  for (const auto& [id, trajectory] : run.truth.targets)
  {
    auto* owner = &scene.robot;
    for (std::size_t i = scene.targets.size(); i-- > 0;)
      if (i < tracks.size() && tracks[i].truthId == id) owner = &scene.targets[i];
    appendTruth(owner->truth, mapFromTruth, trajectory);
  }
}

/// The points that a scan saw, in the map's frame.
void appendPoints(std::vector<Point2D>& points, const core::LaserScan& scan, const Pose2D& robot)
{
  const Pose2D sensor = math::compose(robot, scan.pose_robot_sensor);
  for (std::size_t i = 0; i < scan.ranges.size(); ++i)
  {
    const double range = scan.ranges[i];
    if (!(range > 0) || range >= scan.rangeMax) continue;
    const double angle = scan.angleMin + static_cast<double>(i) * scan.angleStep;
    points.push_back(math::transform(sensor, {range * std::cos(angle), range * std::sin(angle)}));
  }
}
}  // namespace

mrpt::SceneData sceneOf(const std::string& title, const results::RunView& run,
                        std::vector<core::WeightedPose> particles)
{
  const Pose2D mapFromTruth = math::between(run.evaluation.truthFromMap, Pose2D{});
  mrpt::SceneData scene;
  scene.title = title;
  scene.robot = robotOf(run, mapFromTruth);
  for (const auto& target : run.record.targets)
    scene.targets.push_back(targetOf(target, run.record.rows.size()));
  addTrueTargets(scene, run, mapFromTruth);
  scene.landmarks = run.record.landmarks;
  for (const auto& [id, p] : run.truth.landmarks)
    scene.trueLandmarks.push_back(math::transform(mapFromTruth, p));
  for (const auto& laser : run.record.lasers)
    appendPoints(scene.laserPoints, *laser.scan, run.record.rows[laser.row].robot.mean);
  scene.particles = std::move(particles);
  return scene;
}
}  // namespace slamot::apps
