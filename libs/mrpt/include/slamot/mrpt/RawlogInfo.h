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
  std::string className;            ///< of MRPT, as the log has it
  std::string label;                ///< empty where it has none, or slamot does not read the class
  bool used = false;                ///< whether steps hold what it gave
  std::size_t count = 0;            ///< of its objects
  std::optional<double> firstTime;  ///< [s]; none: its objects have no times
  std::optional<double> lastTime;   ///< [s]

  /// Mean rate [Hz]; none where times do not tell.
  [[nodiscard]] std::optional<double> rate() const;
};

/// What sensors told of landmarks, or of targets.
struct SightingInfo
{
  std::size_t scans = 0;         ///< looks, whatever they saw
  std::size_t empty = 0;         ///< those that saw nothing
  std::size_t count = 0;         ///< sightings or blobs
  std::size_t identified = 0;    ///< those with an identity
  std::size_t ranged = 0;        ///< those with a range
  std::set<std::string> labels;  ///< of blobs
};

/// What is in a rawlog; with `error`, of the part before it.
struct RawlogInfo
{
  std::uint64_t bytes = 0;          ///< size of the file
  bool packed = false;              ///< gz
  bool hasFrames = false;           ///< pairs of actions and sensory frames; else observations only
  std::size_t entries = 0;          ///< objects in the file, one after another
  std::size_t steps = 0;            ///< that a run would have
  std::size_t dropped = 0;          ///< sightings and blobs, as a run would
  std::optional<double> firstTime;  ///< of steps [s]
  std::optional<double> lastTime;   ///< of steps [s]
  std::vector<SensorInfo> sensors;  ///< by class and label
  SightingInfo landmarks;           ///< of landmark sightings
  SightingInfo blobs;               ///< of colour blobs
  core::Starts starts;              ///< as the log's comment text tells
  std::vector<std::string> notes;   ///< problems that a run can live with, or a setting mends
  std::optional<core::Error> error;  ///< the problem that no run gets beyond
};

/// Reads all of a rawlog.  Does not throw for its faults.
[[nodiscard]] RawlogInfo inspectRawlog(const std::string& path);
}  // namespace slamot::mrpt
