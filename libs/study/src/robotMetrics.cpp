#include <algorithm>

#include "metricEntries.h"

namespace slamot::study
{
namespace
{
using eval::ErrorSummary;
using eval::StepError;
using Pick = Value ErrorSummary::*;

std::function<Value(const Measured&)> robot(Pick pick, bool atScans = false)
{
  return [=](const Measured& r)
  { return (atScans ? r.evaluation.robot.atScans : r.evaluation.robot.all).*pick; };
}

Value robotLargest(const Measured& r)
{
  Value out;
  for (const StepError& e : r.evaluation.robot.steps)
    out = std::max(out.value_or(0.0), distance(e));
  return out;
}

std::function<Value(const Measured&)> robotPart(double from, double to)
{
  return [=](const Measured& r) { return partMean(r, r.evaluation.robot.steps, from, to); };
}

Value robotHeadingMean(const Measured& r)
{
  return headingMean(r.evaluation.robot.steps);
}

Value robotNeesMedian(const Measured& r)
{
  return neesMedian(r.evaluation.robot.steps);
}

std::function<Value(const Measured&)> rigidRobot(Pick pick)
{
  return [=](const Measured& r)
  { return r.evaluation.rigid ? r.evaluation.rigid->robot.*pick : std::nullopt; };
}

/// RMSE of one coordinate.
std::function<Value(const Measured&)> robotAxis(Eigen::Index axis)
{
  return [=](const Measured& r) { return axisRmse(r.evaluation.robot.steps, axis); };
}

Value robotHeadingDegrees(const Measured& r)
{
  const Value radians = r.evaluation.robot.all.headingRmse;
  return radians ? Value(math::radToDeg(*radians)) : std::nullopt;
}
}  // namespace

std::vector<MetricEntry> robotMetrics()
{
  using E = ErrorSummary;
  return {
      {{"robot_mean_m", "robot position error, mean [m]", 4}, robot(&E::positionMean)},
      {{"robot_rmse_m", "robot position RMSE [m]", 4}, robot(&E::positionRmse)},
      {{"robot_largest_m", "largest position error of a run [m]", 4}, robotLargest},
      {{"robot_early_mean_m", "robot position error, first quarter [m]", 4}, robotPart(0, 0.25)},
      {{"robot_late_mean_m", "robot position error, last quarter [m]", 4}, robotPart(0.75, 1)},
      {{"robot_heading_mean_rad", "robot heading error, mean [rad]", 4}, robotHeadingMean},
      {{"robot_heading_rmse_rad", "robot heading RMSE [rad]", 4}, robot(&E::headingRmse)},
      {{"robot_scans_mean_m", "robot position error at scans [m]", 4},
       robot(&E::positionMean, true)},
      {{"robot_scans_heading_rmse_rad", "robot heading RMSE at scans [rad]", 4},
       robot(&E::headingRmse, true)},
      {{"robot_nees", "robot NEES, mean (3 expected)", 2}, robot(&E::neesMean)},
      {{"robot_nees_median", "robot NEES, median (2.37 expected)", 2}, robotNeesMedian},
      {{"robot_nees_position", "robot position NEES (2 expected)", 2}, robot(&E::neesPositionMean)},
      {{"robot_coverage95", "robot inside 95% ellipse", 3}, robot(&E::coverage95)},
      {{"robot_scans_coverage95", "robot inside 95% ellipse at scans", 3},
       robot(&E::coverage95, true)},
      {{"robot_x_rmse_m", "robot x RMSE [m]", 4}, robotAxis(0)},
      {{"robot_y_rmse_m", "robot y RMSE [m]", 4}, robotAxis(1)},
      {{"robot_heading_rmse_deg", "robot heading RMSE [deg]", 3}, robotHeadingDegrees},
      {{"robot_rigid_rmse_m", "robot position RMSE, aligned [m]", 4}, rigidRobot(&E::positionRmse)},
  };
}
}  // namespace slamot::study
