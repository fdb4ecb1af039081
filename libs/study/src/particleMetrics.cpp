#include "metricEntries.h"

namespace slamot::study
{
namespace
{
using eval::StepRow;

/// The mean over the steps that have the value: those at which particles were weighed.
template <class F>
Value overSteps(const Measured& run, F&& value)
{
  double sum = 0;
  int count = 0;
  for (const StepRow& step : run.record.steps)
    if (const Value v = value(step)) sum += *v, ++count;
  if (count == 0) return std::nullopt;
  return sum / count;
}

Value essMean(const Measured& r)
{
  return overSteps(r, [](const StepRow& s) { return s.ess; });
}

Value degenerateShare(const Measured& r)
{
  constexpr double kAlmostAll = 0.99;
  return overSteps(r,
                   [](const StepRow& s) -> Value
                   {
                     if (!s.largestWeight) return std::nullopt;
                     return *s.largestWeight > kAlmostAll ? 1 : 0;
                   });
}

Value resampledShare(const Measured& r)
{
  return overSteps(r,
                   [](const StepRow& s) -> Value
                   {
                     if (!s.ess) return std::nullopt;
                     return s.resampled ? 1 : 0;
                   });
}
}  // namespace

std::vector<MetricEntry> particleMetrics()
{
  return {
      {{"ess_mean", "effective sample size, mean", 1}, essMean},
      {{"degenerate_share", "steps with one particle over 99%", 4},
       degenerateShare},
      {{"resampled_share", "steps that resample", 3}, resampledShare},
  };
}
}  // namespace slamot::study
