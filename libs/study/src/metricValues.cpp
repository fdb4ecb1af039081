#include <slamot/math/statistics.h>

#include <cmath>

#include "metricEntries.h"

namespace slamot::study
{
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
