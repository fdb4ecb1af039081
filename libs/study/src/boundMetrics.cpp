#include "metricEntries.h"

namespace slamot::study
{
namespace
{
using Quantity = std::optional<BoundFigures::Figure> BoundFigures::*;
using Figure = double BoundFigures::Figure::*;
using Taken = std::function<Value(const Measured&)>;

constexpr Figure kBound = &BoundFigures::Figure::bound;
constexpr Figure kEfficient = &BoundFigures::Figure::efficient;

Taken figure(Quantity quantity, Figure which, double unit = 1)
{
  return [=](const Measured& r) -> Value
  {
    if (!r.bound || !((*r.bound).*quantity)) return std::nullopt;
    return unit * (*((*r.bound).*quantity)).*which;
  };
}

Taken over(const Taken& least, const Taken& error)
{
  return [=](const Measured& r) -> Value
  {
    const Value a = error(r), b = least(r);
    if (!a || !b || *b <= 0) return std::nullopt;
    return *a / *b;
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
  const Taken robot = [](const Measured& r) { return r.evaluation.robot.all.positionRmse; };
  const Taken heading = [](const Measured& r) { return r.evaluation.robot.all.headingRmse; };
  const auto position = figure(&B::robotPosition, kBound);
  const auto angle = figure(&B::robotHeading, kBound);
  const auto map = figure(&B::map, kBound), target = figure(&B::target, kBound);
  const auto drawnPosition = figure(&B::robotPosition, kEfficient);
  const auto drawnAngle = figure(&B::robotHeading, kEfficient);
  const auto drawnMap = figure(&B::map, kEfficient), drawnTarget = figure(&B::target, kEfficient);
  return {
      {{"robot_pcrb_m", "bound of the robot's position RMSE [m]", 4}, position},
      {{"robot_heading_pcrb_rad", "bound of its heading RMSE [rad]", 4}, angle},
      {{"robot_heading_pcrb_deg", "bound of its heading RMSE [deg]", 3},
       figure(&B::robotHeading, kBound, math::radToDeg(1))},
      {{"landmarks_pcrb_m", "bound of the landmark RMSE [m]", 4}, map},
      {{"target_pcrb_m", "bound of the target's position RMSE [m]", 4}, target},
      {{"robot_rmse_over_pcrb", "robot position RMSE by its bound", 3, "robot_rmse_m",
        "robot_pcrb_m"},
       over(position, robot)},
      {{"robot_heading_rmse_over_pcrb", "robot heading RMSE by its bound", 3,
        "robot_heading_rmse_rad", "robot_heading_pcrb_rad"},
       over(angle, heading)},
      {{"landmarks_rmse_over_pcrb", "landmark RMSE by its bound", 3, "landmarks_rmse_m",
        "landmarks_pcrb_m"},
       over(map, mapError)},
      {{"target_rmse_over_pcrb", "target position RMSE by its bound", 3, "target_rmse_m",
        "target_pcrb_m"},
       over(target, targetError)},
      {{"robot_efficient_rmse_m", "robot position RMSE of the efficient filter [m]", 4},
       drawnPosition},
      {{"robot_heading_efficient_rmse_rad", "its heading RMSE [rad]", 4}, drawnAngle},
      {{"landmarks_efficient_rmse_m", "landmark RMSE of the efficient filter [m]", 4}, drawnMap},
      {{"target_efficient_rmse_m", "target position RMSE of the efficient filter [m]", 4},
       drawnTarget},
      {{"robot_rmse_over_efficient", "robot position RMSE by the efficient filter's", 3,
        "robot_rmse_m", "robot_efficient_rmse_m"},
       over(drawnPosition, robot)},
      {{"robot_heading_rmse_over_efficient", "robot heading RMSE by the efficient filter's", 3,
        "robot_heading_rmse_rad", "robot_heading_efficient_rmse_rad"},
       over(drawnAngle, heading)},
      {{"landmarks_rmse_over_efficient", "landmark RMSE by the efficient filter's", 3,
        "landmarks_rmse_m", "landmarks_efficient_rmse_m"},
       over(drawnMap, mapError)},
      {{"target_rmse_over_efficient", "target position RMSE by the efficient filter's", 3,
        "target_rmse_m", "target_efficient_rmse_m"},
       over(drawnTarget, targetError)},
  };
}
}  // namespace slamot::study
