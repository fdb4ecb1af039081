#pragma once

#include <slamot/eval/Evaluation.h>

#include <cstdint>
#include <optional>
#include <string>

namespace slamot::results
{
/// What a run took; differs from run to run, so it is in summary.json only.
struct Timing
{
  double wallS = 0;         ///< of the whole run [s]
  double cpuS = 0;          ///< of the whole process, all threads [s]
  double stepMedianUs = 0;  ///< of the filter, wall [us]
  double stepP99Us = 0;     ///< of the filter, wall; 1 step in 100 takes longer [us]
  double peakRssMb = 0;     ///< [MB], of the process so far
};

/// What was run, on what.
struct RunInfo
{
  std::string method;      ///< the filter's name
  std::string dataset;     ///< the log, as it was named
  std::uint64_t seed = 1;  ///< that the filter drew by
  std::string config;      ///< the effective configuration, as an ini text
};

/// MRPT's version as numbers and dots.
[[nodiscard]] std::string mrptVersion();

/// summary.json: the keys that users rely on, in a fixed order; null for what has no truth or does
/// not apply.  Numbers are the shortest that read back the same.
[[nodiscard]] std::string summaryJson(const RunInfo& info, const eval::Record& record,
                                      const eval::Evaluation& evaluation, const Timing& timing);

/// Errors and consistency in more detail than the summary has, also as JSON.
[[nodiscard]] std::string evaluationJson(const eval::Record& record,
                                         const eval::Evaluation& evaluation);

/// What later use needs of a folder's summary.json.
struct SavedSummary
{
  std::string method;            ///< name of the filter
  std::string dataset;           ///< the log, as it was named
  bool hasMap = false;           ///< whether the filter makes a map at all
  bool complete = false;         ///< false: interrupted, or the input ended too early
  std::size_t observations = 0;  ///< sightings, blobs and laser scans taken in
  int particles = 0;             ///< 0: not a particle filter
};
/// None if there is no such file.  \throws core::Error (kNonsense) if it is none of ours.
[[nodiscard]] std::optional<SavedSummary> loadSummary(const std::string& folder);

/// The same numbers for a person: a few aligned lines, each with its unit.
/// \param detailed with errors at scans, at sightings and by time since the last sighting.
[[nodiscard]] std::string summaryTable(const eval::Record& record,
                                       const eval::Evaluation& evaluation, bool detailed = false);
}  // namespace slamot::results
