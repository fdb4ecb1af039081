#pragma once

#include <slamot/core/Error.h>
#include <slamot/core/Start.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace slamot::mrpt
{
/// What one sensor gave to a rawlog; actions count as one too.
struct SensorInfo
{
  std::string className;
  std::string label;  ///< empty where it has none, or slamot does not read the class
  bool used = false;  ///< whether steps hold what it gave
  std::size_t count = 0;
  std::optional<double> firstTime, lastTime;  ///< [s]

  /// Mean rate [Hz]; none where times do not tell.
  [[nodiscard]] std::optional<double> rate() const;
};

/// What sensors told of landmarks, or of targets.
struct SightingInfo
{
  std::size_t scans = 0, empty = 0;        ///< empty: that saw nothing
  std::size_t count = 0;                   ///< sightings or blobs
  std::size_t identified = 0, ranged = 0;  ///< those with an identity, with a range
  std::set<std::string> labels;            ///< of blobs
};

/// What is in a rawlog; with `error`, of the part before it.
struct RawlogInfo
{
  std::uint64_t bytes = 0;  ///< size of the file
  bool packed = false;      ///< gz
  bool hasFrames = false;   ///< pairs of actions and sensory frames; else observations only
  std::size_t entries = 0, steps = 0;
  std::size_t dropped = 0;                    ///< sightings and blobs, as a run would
  std::optional<double> firstTime, lastTime;  ///< of steps [s]
  std::vector<SensorInfo> sensors;            ///< by class and label
  SightingInfo landmarks, blobs;
  core::Starts starts;
  std::vector<std::string> notes;    ///< problems that a run can live with, or a setting mends
  std::optional<core::Error> error;  ///< the problem that no run gets beyond
};

/// Reads all of a rawlog.  Does not throw for its faults.
[[nodiscard]] RawlogInfo inspectRawlog(const std::string& path);
}  // namespace slamot::mrpt
