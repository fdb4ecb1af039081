#pragma once

#include <slamot/math/statistics.h>
#include <slamot/study/RunRecord.h>

namespace slamot::study
{
/// All records of a study that are there.
struct Outcome
{
  std::vector<std::optional<RunRecord>> records;  ///< in the order of Plan::runs
  std::size_t missing = 0;                        ///< runs without a good record
  std::size_t failed = 0;                         ///< runs that threw; their records say why
  std::size_t stale = 0;                          ///< files of another spec or damaged, left out

  /// Whether every run is there, and none failed.
  [[nodiscard]] bool complete() const { return missing == 0 && failed == 0; }

  /// A metric of a group's runs, by the seed's place; absent where there is none.
  [[nodiscard]] std::vector<std::optional<double>> values(const Plan& plan, std::size_t group,
                                                          std::size_t metric) const;

  /// A metric of a group over its runs, with its 95% interval: the mean, of a ratio to a bound
  /// that of mean squares.  Count 0 if no run has it.
  [[nodiscard]] math::MeanInterval summary(const Plan& plan, std::size_t group,
                                           std::size_t metric) const;
  /// The same by that of a reference group, paired by seed; none if they have nothing to compare.
  [[nodiscard]] std::optional<math::MeanInterval> ratio(const Plan& plan, std::size_t group,
                                                        std::size_t reference,
                                                        std::size_t metric) const;
};

/// Reads what is in the folders, which may each hold a part; the first good record of a run counts.
[[nodiscard]] Outcome collect(const Plan& plan, const std::vector<std::string>& folders);

/// The folders of records in `folder`: itself, or those directly in it.
/// \throws core::Error (kUnreadable) if there is none.
[[nodiscard]] std::vector<std::string> recordFolders(const std::string& folder);

/// Mean, deviation and interval over the runs that have the metric.
[[nodiscard]] math::MeanInterval statistics(const std::vector<std::optional<double>>& values);

/// The ratio of two methods' means over the seeds that both have, with its 95% interval from the
/// paired residuals a - r b.  Cochran, "Sampling Techniques", 1977, eq. 6.13.  `std` is that of the
/// residuals by the mean of b; none if that mean is 0.
[[nodiscard]] std::optional<math::MeanInterval> pairedRatio(
    const std::vector<std::optional<double>>& a, const std::vector<std::optional<double>>& b);

/// The root of the ratio of the mean squares, with its interval from the same residuals of squares,
/// to first order.  `std` is that of the runs' own ratios a / b.
[[nodiscard]] std::optional<math::MeanInterval> pairedRootRatio(
    const std::vector<std::optional<double>>& a, const std::vector<std::optional<double>>& b);
}  // namespace slamot::study
