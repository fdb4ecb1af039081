#include <slamot/math/statistics.h>

#include <cmath>

#include "metricEntries.h"

namespace slamot::study
{
std::vector<Value> presentMeans(const std::vector<std::vector<Value>>& lists)
{
  std::vector<Value> out(lists.front().size());
  for (std::size_t i = 0; i < out.size(); ++i)
  {
    double sum = 0;
    int count = 0;
    for (const auto& list : lists)
      if (list[i]) sum += *list[i], ++count;
    if (count > 0) out[i] = sum / count;
  }
  return out;
}

double distance(const eval::StepError& s)
{
  return s.error.head<2>().norm();
}

Value meanOver(const std::vector<eval::StepError>& steps,
               const std::function<bool(const eval::StepError&)>& use,
               const std::function<double(const eval::StepError&)>& value)
{
  double sum = 0;
  int count = 0;
  for (const eval::StepError& s : steps)
    if (use(s)) sum += value(s), ++count;
  if (count == 0) return std::nullopt;
  return sum / count;
}

Value partMean(const Measured& run, const std::vector<eval::StepError>& steps, double from,
               double to)
{
  const auto rows = static_cast<double>(run.record.rows.size());
  return meanOver(
      steps,
      [&](const eval::StepError& s)
      {
        const auto row = static_cast<double>(s.row);
        return row >= from * rows && row < to * rows;
      },
      distance);
}

Value axisRmse(const std::vector<eval::StepError>& steps, Eigen::Index axis)
{
  const Value squared = meanOver(
      steps, [](const eval::StepError&) { return true; },
      [=](const eval::StepError& s) { return s.error[axis] * s.error[axis]; });
  return squared ? Value(std::sqrt(*squared)) : std::nullopt;
}

Value headingMean(const std::vector<eval::StepError>& steps)
{
  return meanOver(
      steps, [](const eval::StepError& s) { return s.headingKnown; },
      [](const eval::StepError& s) { return std::abs(s.error[2]); });
}

Value neesMedian(const std::vector<eval::StepError>& steps)
{
  std::vector<double> values;
  for (const eval::StepError& s : steps)
    if (s.nees) values.push_back(*s.nees);
  if (values.empty()) return std::nullopt;
  return math::quantile(values, 0.5);
}
}  // namespace slamot::study
