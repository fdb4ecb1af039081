#include <slamot/eval/Evaluation.h>

#include <algorithm>

namespace slamot::eval
{
namespace
{
/// The pose nearest in time; none if it is farther than the tolerance.
const TimedPose* poseNear(const Trajectory& path, double time, double tolerance)
{
  const auto earlier = [](const TimedPose& p, double t) { return p.time < t; };
  const auto after = std::lower_bound(path.poses.begin(), path.poses.end(), time, earlier);
  const TimedPose* best = nullptr;
  const auto consider = [&](const TimedPose& p)
  {
    const double off = std::abs(p.time - time);
    if (off <= tolerance && (!best || off < std::abs(best->time - time))) best = &p;
  };
  if (after != path.poses.begin()) consider(*std::prev(after));
  if (after != path.poses.end()) consider(*after);
  return best;
}
}  // namespace

std::optional<RelationErrors> evaluateRelations(const Trajectory& path,
                                                const std::vector<Relation>& relations,
                                                double tolerance)
{
  if (relations.empty()) return std::nullopt;
  RelationErrors out;
  double translation = 0, rotation = 0;
  for (const Relation& r : relations)
  {
    const TimedPose* from = poseNear(path, r.from, tolerance);
    const TimedPose* to = poseNear(path, r.to, tolerance);
    if (!from || !to) continue;
    const Pose2D off = math::between(r.pose_from_to, math::between(from->pose, to->pose));
    translation += std::hypot(off.x, off.y);
    rotation += std::abs(off.phi);
    ++out.count;
  }
  if (out.count == 0) return out;
  out.translationMean = translation / out.count;
  out.rotationMean = rotation / out.count;
  return out;
}

std::optional<RelationErrors> evaluateRelations(const Record& record,
                                                const std::vector<Relation>& relations)
{
  if (relations.empty()) return std::nullopt;
  Trajectory path;
  for (const RobotRow& row : record.rows) path.poses.push_back({row.time, row.robot.mean, true});
  return evaluateRelations(path, relations);
}
}  // namespace slamot::eval
