#pragma once

#include <slamot/eval/Record.h>

#include <string>

namespace slamot::results
{
/// Writes what was recorded into a folder: robot.tum, robot.csv, target_<id>.tum, target_<id>.csv,
/// landmarks.csv, and for later evaluation diagnostics.csv (one row a step) and pairings.csv (one a
/// sighting or blob); path by odometry
/// alone, odometry.tum; where the filter keeps its path, path/robot.tum.  Numbers are the shortest
/// that read back the same, `.` before decimals. \throws core::Error: kInternal on a value that is
/// not finite, kUnreadable if writing fails.
void saveRecord(const std::string& folder, const eval::Record& record);

/// Reads it back: rows, targets, landmarks, pairings and diagnostics, so that an evaluation of it
/// gives the same numbers.  Of a folder without robot.csv, robot.tum makes rows without covariance.
/// \throws core::Error (kUnreadable, kTruncated, kNonsense) on what is no result folder.
[[nodiscard]] eval::Record loadRecord(const std::string& folder);

/// The rows of a TUM file, without covariance.
[[nodiscard]] eval::Record loadTumRecord(const std::string& path);
}  // namespace slamot::results
