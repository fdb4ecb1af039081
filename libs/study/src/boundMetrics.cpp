#include "metricEntries.h"

namespace slamot::study
{
namespace
{
using Figure = Value BoundFigures::*;
using Taken = std::function<Value(const Measured&)>;

Taken figure(Figure which, double unit = 1)
{
  return [=](const Measured& r) -> Value
  {
    if (!r.bound || !((*r.bound).*which)) return std::nullopt;
    return unit * *((*r.bound).*which);
  };
}

Taken over(Figure which, const Taken& error)
{
  return [=](const Measured& r) -> Value
  {
    const Value bound = figure(which)(r), value = error(r);
    if (!bound || !value || *bound <= 0) return std::nullopt;
    return *value / *bound;
  };
}

// Of maps by identities only: what is matched by distance has small errors for just that.
Value mapError(const Measured& r)
{
  const auto& l = r.evaluation.landmarks;
  const bool isWhole = l.seen && l.trueOnes == l.seen && r.record.landmarksIdentified();
  return isWhole ? l.rmse : std::nullopt;
}

Value targetError(const Measured& r)
{
  double sum = 0;
  for (const auto& t : r.evaluation.trueTargets)
  {
    if (!t.all.positionRmse) return std::nullopt;
    sum += *t.all.positionRmse;
  }
  const auto count = static_cast<double>(r.evaluation.trueTargets.size());
  return count > 0 ? Value(sum / count) : std::nullopt;
}
}  // namespace

std::vector<MetricEntry> boundMetrics()
{
  using B = BoundFigures;
  const auto robot = [](const Measured& r) { return r.evaluation.robot.all.positionRmse; };
  const auto heading = [](const Measured& r) { return r.evaluation.robot.all.headingRmse; };
  return {
      {{"robot_pcrb_m", "bound of the robot's position RMSE [m]", 4}, figure(&B::robotPosition)},
      {{"robot_heading_pcrb_rad", "bound of its heading RMSE [rad]", 4}, figure(&B::robotHeading)},
      {{"robot_heading_pcrb_deg", "bound of its heading RMSE [deg]", 3},
       figure(&B::robotHeading, math::radToDeg(1))},
      {{"landmarks_pcrb_m", "bound of the landmark RMSE [m]", 4}, figure(&B::map)},
      {{"target_pcrb_m", "bound of the target's position RMSE [m]", 4}, figure(&B::target)},
      {{"robot_rmse_over_pcrb", "robot position RMSE by its bound", 3, "robot_rmse_m",
        "robot_pcrb_m"},
       over(&B::robotPosition, robot)},
      {{"robot_heading_rmse_over_pcrb", "robot heading RMSE by its bound", 3,
        "robot_heading_rmse_rad", "robot_heading_pcrb_rad"},
       over(&B::robotHeading, heading)},
      {{"landmarks_rmse_over_pcrb", "landmark RMSE by its bound", 3, "landmarks_rmse_m",
        "landmarks_pcrb_m"},
       over(&B::map, mapError)},
      {{"target_rmse_over_pcrb", "target position RMSE by its bound", 3, "target_rmse_m",
        "target_pcrb_m"},
       over(&B::target, targetError)},
  };
}
}  // namespace slamot::study
