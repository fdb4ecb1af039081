#include <algorithm>

#include "metricEntries.h"

namespace slamot::study
{
namespace
{
using eval::ErrorSummary;
using eval::StepError;
using Pick = Value ErrorSummary::*;

/// The mean over the true targets that have the value.
template <class F>
Value overTargets(const Measured& run, F&& value)
{
  double sum = 0;
  int count = 0;
  for (const eval::TargetEvaluation& t : run.evaluation.trueTargets)
    if (const Value v = value(t)) sum += *v, ++count;
  if (count == 0) return std::nullopt;
  return sum / count;
}

std::function<Value(const Measured&)> target(ErrorSummary eval::TargetEvaluation::*part, Pick pick)
{
  return [=](const Measured& r)
  { return overTargets(r, [=](const eval::TargetEvaluation& t) { return (t.*part).*pick; }); };
}

Value targetNeesMedian(const Measured& r)
{
  return overTargets(r, [](const auto& t) { return neesMedian(t.steps); });
}

Value targetHeadingMean(const Measured& r)
{
  return overTargets(r, [](const auto& t) { return headingMean(t.steps); });
}

Value targetEarly(const Measured& r)
{
  return overTargets(r, [&](const auto& t) { return partMean(r, t.steps, 0, 0.25); });
}

Value targetLate(const Measured& r)
{
  return overTargets(r, [&](const auto& t) { return partMean(r, t.steps, 0.75, 1); });
}

/// Of targets unseen for `part` of eval::EvaluationOptions::sinceSeenEdges.
std::function<Value(const Measured&)> targetUnseen(std::size_t part)
{
  const auto rmse = [=](const eval::TargetEvaluation& t) -> Value
  {
    if (part >= t.sinceSeen.size()) return std::nullopt;
    return t.sinceSeen[part].errors.positionRmse;
  };
  return [=](const Measured& r) { return overTargets(r, rmse); };
}

Value targetSpeed(const Measured& r)
{
  return overTargets(r, [](const auto& t) { return t.speedRmse; });
}

Value targetTrackedSinceMoved(const Measured& r)
{
  return overTargets(r, [](const auto& t) { return t.trackedSinceMoved; });
}

/// RMSE of one coordinate of the place.
std::function<Value(const Measured&)> targetAxis(Eigen::Index axis)
{
  const auto rmse = [=](const eval::TargetEvaluation& t) { return axisRmse(t.steps, axis); };
  return [=](const Measured& r) { return overTargets(r, rmse); };
}

/// The same of the velocity.
std::function<Value(const Measured&)> targetVelocity(Eigen::Index axis)
{
  const auto rmse = [=](const eval::TargetEvaluation& t)
  { return t.velocityRmse ? Value((*t.velocityRmse)[axis]) : std::nullopt; };
  return [=](const Measured& r) { return overTargets(r, rmse); };
}

/// Tracks that stand for no true target.
Value falseTracks(const Measured& r)
{
  if (r.evaluation.trueTargets.empty()) return std::nullopt;
  const auto& tracks = r.evaluation.targets;
  return static_cast<double>(
      std::count_if(tracks.begin(), tracks.end(), [](const auto& t) { return !t.truthId; }));
}

Value targetTracked(const Measured& r)
{
  return overTargets(r, [](const auto& t) { return t.trackedFraction; });
}

/// What an evaluation says of the targets as a set; null if nothing.
using TargetSetOf = const eval::TargetSetErrors* (*)(const eval::Evaluation&);
constexpr TargetSetOf kTargetSet = [](const eval::Evaluation& e)
{ return e.targetSet ? &*e.targetSet : nullptr; };
constexpr TargetSetOf kRigidTargetSet = [](const eval::Evaluation& e)
{ return e.rigid && e.rigid->targetSet ? &*e.rigid->targetSet : nullptr; };

std::function<Value(const Measured&)> targetSet(TargetSetOf set,
                                                double eval::TargetSetErrors::*which)
{
  return [=](const Measured& r) -> Value
  {
    const auto* t = set(r.evaluation);
    return t ? Value(t->*which) : std::nullopt;
  };
}
}  // namespace

std::vector<MetricEntry> targetMetrics()
{
  using E = ErrorSummary;
  using T = eval::TargetEvaluation;
  using S = eval::TargetSetErrors;
  return {
      {{"target_mean_m", "target position error, mean [m]", 4}, target(&T::all, &E::positionMean)},
      {{"target_rmse_m", "target position RMSE [m]", 4}, target(&T::all, &E::positionRmse)},
      {{"target_heading_mean_rad", "target heading error, mean [rad]", 4}, targetHeadingMean},
      {{"target_heading_rmse_rad", "target heading RMSE [rad]", 4},
       target(&T::all, &E::headingRmse)},
      {{"target_scans_mean_m", "target position error at scans [m]", 4},
       target(&T::atScans, &E::positionMean)},
      {{"target_scans_heading_rmse_rad", "target heading RMSE at scans [rad]", 4},
       target(&T::atScans, &E::headingRmse)},
      {{"target_early_mean_m", "target position error, first quarter [m]", 4}, targetEarly},
      {{"target_late_mean_m", "target position error, last quarter [m]", 4}, targetLate},
      {{"target_relative_mean_m", "target error from the robot, at sightings [m]", 4},
       target(&T::relativeAtSightings, &E::positionMean)},
      {{"target_relative_rmse_m", "target RMSE from the robot, at sightings [m]", 4},
       target(&T::relativeAtSightings, &E::positionRmse)},
      {{"target_unseen_0_1_rmse_m", "target RMSE, seen in the last second [m]", 3},
       targetUnseen(0)},
      {{"target_unseen_1_3_rmse_m", "unseen for 1 to 3 s [m]", 3}, targetUnseen(1)},
      {{"target_unseen_3_10_rmse_m", "unseen for 3 to 10 s [m]", 3}, targetUnseen(2)},
      {{"target_unseen_10_30_rmse_m", "unseen for 10 to 30 s [m]", 3}, targetUnseen(3)},
      {{"target_nees", "target NEES, mean (3 expected)", 2}, target(&T::all, &E::neesMean)},
      {{"target_nees_median", "target NEES, median (2.37 expected)", 2}, targetNeesMedian},
      {{"target_nees_position", "target position NEES (2 expected)", 2},
       target(&T::all, &E::neesPositionMean)},
      {{"target_coverage95", "target inside 95% ellipse", 3}, target(&T::all, &E::coverage95)},
      {{"target_scans_coverage95", "target inside 95% ellipse at scans", 3},
       target(&T::atScans, &E::coverage95)},
      {{"target_tracked", "share of time the target is tracked", 3}, targetTracked},
      {{"target_tracked_since_moved", "the same since it first moved", 3}, targetTrackedSinceMoved},
      {{"target_speed_rmse_mps", "target speed RMSE [m/s]", 3}, targetSpeed},
      {{"target_x_rmse_m", "target x RMSE [m]", 4}, targetAxis(0)},
      {{"target_y_rmse_m", "target y RMSE [m]", 4}, targetAxis(1)},
      {{"target_vx_rmse_mps", "target vx RMSE [m/s]", 4}, targetVelocity(0)},
      {{"target_vy_rmse_mps", "target vy RMSE [m/s]", 4}, targetVelocity(1)},
      {{"false_tracks", "tracks of no true target", 1}, falseTracks},
      {{"targets_tracked_mean", "targets tracked, mean", 2}, targetSet(kTargetSet, &S::estimated)},
      {{"targets_there_mean", "targets there, mean", 2}, targetSet(kTargetSet, &S::truly)},
      {{"targets_gospa_m", "target GOSPA, mean [m]", 3}, targetSet(kTargetSet, &S::gospa)},
      {{"targets_localisation_m2", "its part localisation, mean [m2]", 3},
       targetSet(kTargetSet, &S::localisation)},
      {{"targets_missed_m2", "its part missed, mean [m2]", 3}, targetSet(kTargetSet, &S::missed)},
      {{"targets_false_m2", "its part false, mean [m2]", 3}, targetSet(kTargetSet, &S::falseOnes)},
      {{"targets_ospa_m", "target OSPA, mean [m]", 3}, targetSet(kTargetSet, &S::ospa)},
      {{"targets_rigid_gospa_m", "target GOSPA, aligned, mean [m]", 3},
       targetSet(kRigidTargetSet, &S::gospa)},
      {{"targets_rigid_ospa_m", "target OSPA, aligned, mean [m]", 3},
       targetSet(kRigidTargetSet, &S::ospa)},
  };
}
}  // namespace slamot::study
