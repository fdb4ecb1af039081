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

/// Appends a track's pieces, and its end if it is followed to the end of the run.
void append(mrpt::SceneTrack& out, const eval::TargetTrack& target, std::size_t rowsOfRun)
{
  for (std::size_t i = 0; i < target.rows.size(); ++i)
  {
    const auto& row = target.rows[i];
    if (i == 0 || row.row != target.rows[i - 1].row + 1) out.path.emplace_back();
    out.path.back().push_back({row.pose.mean.x, row.pose.mean.y});
  }
  if (!target.rows.empty() && target.rows.back().row + 1 == rowsOfRun)
    out.now = target.rows.back().pose;
}

/// All tracks of a true target with its true path; that of one never tracked goes to the robot's.
void addTargets(mrpt::SceneData& scene, const results::RunView& run, const Pose2D& mapFromTruth)
{
  for (const auto& group : results::targetGroups(run.record, run.evaluation))
  {
    mrpt::SceneTrack track;
    track.name = group.name;
    for (const std::size_t i : group.tracks)
      append(track, run.record.targets[i], run.record.rows.size());
    auto& truth = track.path.empty() ? scene.robot.truth : track.truth;
    if (group.truthId) appendTruth(truth, mapFromTruth, run.truth.targets.at(*group.truthId));
    if (!track.path.empty()) scene.targets.push_back(std::move(track));
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
  addTargets(scene, run, mapFromTruth);
  scene.landmarks = run.record.landmarks;
  for (const auto& [id, p] : run.truth.landmarks)
    scene.trueLandmarks.push_back(math::transform(mapFromTruth, p));
  for (const auto& laser : run.record.lasers)
    appendPoints(scene.laserPoints, *laser.scan, run.record.rows[laser.row].robot.mean);
  scene.particles = std::move(particles);
  return scene;
}
}  // namespace slamot::apps
