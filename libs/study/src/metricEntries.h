#pragma once

#include <slamot/study/Metrics.h>

#include <functional>

/// The metrics by what they are of, each with how to take it.
namespace slamot::study
{
using Value = std::optional<double>;

/// What a metric is taken from.
struct Measured
{
  const eval::Record& record;
  const eval::Evaluation& evaluation;
  const MessageFigures* messages = nullptr;  ///< of a robot in a team
  const BoundFigures* bound = nullptr;       ///< of a simulated world
};

struct MetricEntry
{
  Metric metric;
  std::function<Value(const Measured&)> value;  ///< none: has no truth, or does not apply
};

[[nodiscard]] std::vector<MetricEntry> robotMetrics();
[[nodiscard]] std::vector<MetricEntry> targetMetrics();
[[nodiscard]] std::vector<MetricEntry> particleMetrics();
[[nodiscard]] std::vector<MetricEntry> mapMetrics();
[[nodiscard]] std::vector<MetricEntry> boundMetrics();
[[nodiscard]] std::vector<MetricEntry> messageMetrics();

/// Mean of `value` over the steps that `use` takes.
[[nodiscard]] Value meanOver(const std::vector<eval::StepError>& steps,
                             const std::function<bool(const eval::StepError&)>& use,
                             const std::function<double(const eval::StepError&)>& value);
/// Mean position error over the rows in [from, to), as shares of the run [m].
[[nodiscard]] Value partMean(const Measured& run, const std::vector<eval::StepError>& steps,
                             double from, double to);
/// Root mean square of one coordinate's error.
[[nodiscard]] Value axisRmse(const std::vector<eval::StepError>& steps, Eigen::Index axis);
/// Of the errors' sizes [rad].
[[nodiscard]] Value headingMean(const std::vector<eval::StepError>& steps);
/// A collapsed particle set claims certainty, and its NEES outweighs all others in a mean.
[[nodiscard]] Value neesMedian(const std::vector<eval::StepError>& steps);
/// Each place's mean over the lists that have it; all are of one length, and there is one at least.
[[nodiscard]] std::vector<Value> presentMeans(const std::vector<std::vector<Value>>& lists);
/// [m]
[[nodiscard]] double distance(const eval::StepError& s);

template <class T>
Value number(const std::optional<T>& v)
{
  if (!v) return std::nullopt;
  return static_cast<double>(*v);
}
}  // namespace slamot::study
