#include <slamot/math/statistics.h>
#include <slamot/study/Metrics.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>

namespace slamot::study
{
namespace
{
using Value = std::optional<double>;
using eval::ErrorSummary;
using eval::StepError;

struct Run
{
  const eval::Record& record;
  const eval::Evaluation& evaluation;
  const MessageFigures* messages = nullptr;
};

double distance(const StepError& s)
{
  return s.error.head<2>().norm();
}

/// Mean of `value` over the steps that `use` takes.
Value meanOver(const std::vector<StepError>& steps,
               const std::function<bool(const StepError&)>& use,
               const std::function<double(const StepError&)>& value)
{
  double sum = 0;
  int count = 0;
  for (const StepError& s : steps)
    if (use(s)) sum += value(s), ++count;
  if (count == 0) return std::nullopt;
  return sum / count;
}

Value headingMean(const std::vector<StepError>& steps)
{
  return meanOver(
      steps, [](const StepError& s) { return s.headingKnown; },
      [](const StepError& s) { return std::abs(s.error[2]); });
}

/// A collapsed particle set claims certainty, and its NEES outweighs all others in a mean.
Value neesMedian(const std::vector<StepError>& steps)
{
  std::vector<double> values;
  for (const StepError& s : steps)
    if (s.nees) values.push_back(*s.nees);
  if (values.empty()) return std::nullopt;
  return math::quantile(values, 0.5);
}

/// Mean position error over the rows in [from, to), as shares of the run.
Value partMean(const Run& run, const std::vector<StepError>& steps, double from, double to)
{
  const auto rows = static_cast<double>(run.record.rows.size());
  return meanOver(
      steps,
      [&](const StepError& s)
      {
        const auto row = static_cast<double>(s.row);
        return row >= from * rows && row < to * rows;
      },
      distance);
}

/// The mean over the true targets that have the value.
template <class F>
Value overTargets(const Run& run, F&& value)
{
  double sum = 0;
  int count = 0;
  for (const eval::TargetEvaluation& t : run.evaluation.trueTargets)
    if (const Value v = value(t)) sum += *v, ++count;
  if (count == 0) return std::nullopt;
  return sum / count;
}

template <class T>
Value number(const std::optional<T>& v)
{
  if (!v) return std::nullopt;
  return static_cast<double>(*v);
}

using Pick = Value ErrorSummary::*;

std::function<Value(const Run&)> robot(Pick pick, bool atScans = false)
{
  return [=](const Run& r)
  { return (atScans ? r.evaluation.robot.atScans : r.evaluation.robot.all).*pick; };
}

std::function<Value(const Run&)> target(ErrorSummary eval::TargetEvaluation::*part, Pick pick)
{
  return [=](const Run& r)
  { return overTargets(r, [=](const eval::TargetEvaluation& t) { return (t.*part).*pick; }); };
}

Value robotLargest(const Run& r)
{
  Value out;
  for (const StepError& e : r.evaluation.robot.steps)
    out = std::max(out.value_or(0.0), distance(e));
  return out;
}

Value robotHeadingMean(const Run& r)
{
  return headingMean(r.evaluation.robot.steps);
}

Value robotNeesMedian(const Run& r)
{
  return neesMedian(r.evaluation.robot.steps);
}

Value targetNeesMedian(const Run& r)
{
  return overTargets(r, [](const auto& t) { return neesMedian(t.steps); });
}

Value targetHeadingMean(const Run& r)
{
  return overTargets(r, [](const auto& t) { return headingMean(t.steps); });
}

Value targetEarly(const Run& r)
{
  return overTargets(r, [&](const auto& t) { return partMean(r, t.steps, 0, 0.25); });
}

Value targetLate(const Run& r)
{
  return overTargets(r, [&](const auto& t) { return partMean(r, t.steps, 0.75, 1); });
}

/// Of targets unseen for `part` of eval::EvaluationOptions::sinceSeenEdges.
std::function<Value(const Run&)> targetUnseen(std::size_t part)
{
  const auto rmse = [=](const eval::TargetEvaluation& t) -> Value
  {
    if (part >= t.sinceSeen.size()) return std::nullopt;
    return t.sinceSeen[part].errors.positionRmse;
  };
  return [=](const Run& r) { return overTargets(r, rmse); };
}

Value targetTracked(const Run& r)
{
  return overTargets(r, [](const auto& t) { return t.trackedFraction; });
}

Value falseLandmarks(const Run& r)
{
  const auto& l = r.evaluation.landmarks;
  if (!l.mapped || !l.trueOnes) return std::nullopt;
  return *l.mapped - *l.trueOnes;
}

Value gospa(const Run& r)
{
  if (!r.evaluation.landmarks.gospa) return std::nullopt;
  return r.evaluation.landmarks.gospa->total;
}

Value pairs(const Run& r, std::optional<int> eval::AssociationCounts::*which)
{
  if (!r.evaluation.association) return std::nullopt;
  return number((*r.evaluation.association).*which);
}

std::function<Value(const Run&)> exchanged(double MessageFigures::*which)
{
  return [which](const Run& r) { return r.messages ? Value(r.messages->*which) : std::nullopt; };
}

struct Entry
{
  Metric metric;
  std::function<Value(const Run&)> value;
};

const std::vector<Entry>& entries()
{
  using E = ErrorSummary;
  using T = eval::TargetEvaluation;
  static const std::vector<Entry> list = {
      {{"robot_mean_m", "robot position error, mean [m]", 4}, robot(&E::positionMean)},
      {{"robot_rmse_m", "robot position RMSE [m]", 4}, robot(&E::positionRmse)},
      {{"robot_largest_m", "largest position error of a run [m]", 4}, robotLargest},
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
      {{"landmarks_mapped", "landmarks mapped", 1},
       [](const Run& r) { return number(r.evaluation.landmarks.mapped); }},
      {{"landmarks_false", "of them false", 2}, falseLandmarks},
      {{"landmarks_rmse_m", "landmark RMSE [m]", 4},
       [](const Run& r) { return r.evaluation.landmarks.rmse; }},
      {{"landmarks_gospa_m", "landmark GOSPA [m]", 3}, gospa},
      {{"pairs_correct", "sightings paired rightly", 1},
       [](const Run& r) { return pairs(r, &eval::AssociationCounts::correct); }},
      {{"pairs_wrong", "sightings paired wrongly", 2},
       [](const Run& r) { return pairs(r, &eval::AssociationCounts::wrong); }},
      {{"messages_sent", "messages sent", 1}, exchanged(&MessageFigures::sent)},
      {{"message_bytes", "bytes sent", 0}, exchanged(&MessageFigures::bytes)},
      {{"messages_fused", "messages fused", 1}, exchanged(&MessageFigures::fused)},
      {{"candidates_fused", "of them with a sighting", 1}, exchanged(&MessageFigures::candidates)},
      {{"candidates_wrong", "of these wrong", 3},
       [](const Run& r) { return r.messages ? r.messages->wrong : std::nullopt; }},
  };
  return list;
}
}  // namespace

const std::vector<Metric>& metrics()
{
  static const std::vector<Metric> list = []
  {
    std::vector<Metric> out;
    for (const Entry& e : entries()) out.push_back(e.metric);
    return out;
  }();
  return list;
}

std::optional<std::size_t> metricByName(const std::string& name)
{
  const auto& list = metrics();
  const auto it =
      std::find_if(list.begin(), list.end(), [&](const Metric& m) { return m.name == name; });
  if (it == list.end()) return std::nullopt;
  return static_cast<std::size_t>(it - list.begin());
}

std::vector<std::optional<double>> measure(const eval::Record& record,
                                           const eval::Evaluation& evaluation,
                                           const MessageFigures* messages)
{
  std::vector<std::optional<double>> out;
  for (const Entry& e : entries()) out.push_back(e.value({record, evaluation, messages}));
  return out;
}

std::vector<std::optional<double>> meanOf(
    const std::vector<std::vector<std::optional<double>>>& robots)
{
  std::vector<std::optional<double>> out(entries().size());
  for (std::size_t m = 0; m < out.size(); ++m)
  {
    double sum = 0;
    int count = 0;
    for (const auto& robot : robots)
      if (robot[m]) sum += *robot[m], ++count;
    if (count > 0) out[m] = sum / count;
  }
  return out;
}
}  // namespace slamot::study
