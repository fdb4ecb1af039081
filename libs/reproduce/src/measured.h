#pragma once

#include <slamot/reproduce/Condition.h>
#include <slamot/study/Outcome.h>

namespace slamot::reproduce
{
/// The CPU time of a run, which is no metric of its result [s].
inline constexpr const char* kCpuTime = "cpu_s";

/// Whether a metric is a root of a ratio of mean squares over the seeds.
[[nodiscard]] bool isRootOfMeans(const std::string& metric);

/// What a metric, or cpu_s, is called in tables, and with how many decimals.
[[nodiscard]] std::string labelOf(const std::string& metric);
[[nodiscard]] int decimalsOf(const std::string& metric);

/// The left side of a condition in one cell: its mean, or ratio of means, over the seeds.
struct Measured
{
  std::string cell;  ///< what is said of axes that the condition leaves open; empty: none is
  math::MeanInterval value;  ///< count 0: no run has it
  int seeds = 0;             ///< of the study
  bool isByPositive = true;  ///< what it is divided by is above 0 in each run, or with its interval
};

/// One for each combination of the open axes; none if a method or a value is not in this study.
[[nodiscard]] std::vector<Measured> measure(const Condition& condition, const study::Plan& plan,
                                            const study::Outcome& outcome);
}  // namespace slamot::reproduce
