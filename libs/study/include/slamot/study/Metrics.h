#pragma once

#include <slamot/eval/Evaluation.h>
#include <slamot/eval/Record.h>

#include <optional>
#include <string>
#include <vector>

namespace slamot::study
{
/// A number that a run is judged by.  Those of targets are the mean over the true targets.
struct Metric
{
  const char* name;   ///< with its unit, as in columns of files
  const char* label;  ///< for tables and plots
  int decimals;       ///< that a table shows
};

/// All metrics, in the order of files.
[[nodiscard]] const std::vector<Metric>& metrics();

/// The place of a metric by its name; none if there is no such metric.
[[nodiscard]] std::optional<std::size_t> metricByName(const std::string& name);

/// The metrics of a run, in the order of metrics(); absent is what has no truth or does not apply.
[[nodiscard]] std::vector<std::optional<double>> measure(const eval::Record& record,
                                                         const eval::Evaluation& evaluation);
}  // namespace slamot::study
