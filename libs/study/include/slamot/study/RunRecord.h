#pragma once

#include <slamot/study/ErrorCurves.h>
#include <slamot/study/Plan.h>

#include <optional>

namespace slamot::study
{
/// What became of one run.
struct RunRecord
{
  std::string hash;        ///< Group::hash
  std::uint64_t seed = 0;  ///< that was run
  std::string error;       ///< empty, or why it failed
  int status = 0;          ///< and with what exit status
  std::vector<std::optional<double>>
      metrics;         ///< in the order of study::metrics(); if it failed, empty
  ErrorCurves curves;  ///< if the study keeps them
  double wallS = 0;    ///< [s], of its thread
  double cpuS = 0;     ///< [s], of its thread
};

/// What there is of a run's record.
enum class RecordState
{
  kAbsent,   ///< no file
  kStale,    ///< of another spec, or by another version
  kDamaged,  ///< no record at all
  kGood      ///< to be used
};

/// Reads a run's record from a study's folder.
[[nodiscard]] RecordState loadRecord(const std::string& folder, const Plan& plan, const Run& run,
                                     RunRecord& record);

/// Writes it, whole or not at all.  \throws core::Error (kUnreadable).
void saveRecord(const std::string& folder, const Plan& plan, const Run& run,
                const RunRecord& record);
}  // namespace slamot::study
