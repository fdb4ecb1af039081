#include <slamot/eval/ScanMap.h>
#include <slamot/eval/ScansAlong.h>
#include <slamot/eval/Trajectory.h>

#include <algorithm>

#include "movedOn.h"
#include "sameTime.h"

namespace slamot::eval
{
namespace
{
/// The path's own row at a time, or the last one before it.
std::size_t rowAt(const Record& path, double time)
{
  const auto after = std::upper_bound(path.rows.begin(), path.rows.end(), time + kSameTime,
                                      [](double t, const RobotRow& row) { return t < row.time; });
  return static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - path.rows.begin(), 1) - 1);
}

/// Where targets were at a row of the path, to the newest row of what is drawn.
void addTargets(const Record& path, std::size_t row, Record& drawn)
{
  for (std::size_t i = 0; i < path.targets.size(); ++i)
  {
    const auto& rows = path.targets[i].rows;
    const auto at = std::lower_bound(rows.begin(), rows.end(), row,
                                     [](const TargetRow& t, std::size_t r) { return t.row < r; });
    if (at == rows.end() || at->row != row) continue;
    drawn.targets[i].rows.push_back(*at);
    drawn.targets[i].rows.back().row = drawn.rows.size() - 1;
  }
}
}  // namespace

ScansAlong scansAlong(const Record& path, core::Source& log, double maxGap)
{
  Trajectory trajectory;
  for (const RobotRow& row : path.rows)
    trajectory.poses.push_back({row.time, row.robot.mean, true});
  ScansAlong out;
  out.record.targets.resize(path.targets.size());
  std::vector<RobotRow>& rows = out.record.rows;
  Pose2D since;  // by odometry, since the newest row
  while (const auto step = log.next())
  {
    if (step->odometry) since = math::compose(since, step->odometry->mean);
    if (step->lasers.empty()) continue;
    const auto pose = trajectory.at(step->time, maxGap);
    if (!pose) out.leftOut += step->lasers.size();
    if (!pose || (!rows.empty() && !movedOn(rows.back().robot.mean, pose->pose))) continue;
    RobotRow row;
    row.time = step->time;
    row.robot.mean = pose->pose;
    row.odometry = rows.empty() ? pose->pose : math::compose(rows.back().odometry, since);
    since = Pose2D();
    rows.push_back(row);
    addTargets(path, rowAt(path, step->time), out.record);
    for (const auto& scan : step->lasers) out.record.lasers.push_back({rows.size() - 1, scan});
  }
  out.record.lasers = withoutTargets(out.record);
  return out;
}
}  // namespace slamot::eval
