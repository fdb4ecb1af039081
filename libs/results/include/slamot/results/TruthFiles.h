#pragma once

#include <slamot/eval/Truth.h>

#include <string>

namespace slamot::results
{
/// The folder of a log's truth: X.truth for X.rawlog.
[[nodiscard]] std::string truthFolder(const std::string& rawlogPath);

/// Reads robot.tum, target_<id>.tum, landmarks.csv and associations.csv; what is absent stays empty.
/// \throws core::Error (kUnreadable, kTruncated, kNonsense) on a malformed file, with its line.
[[nodiscard]] eval::Truth loadTruth(const std::string& folder);

/// Writes what the truth holds; the folder is made, and what was in it from before is replaced.
void saveTruth(const std::string& folder, const eval::Truth& truth);

/// TUM format: `timestamp x y z qx qy qz qw`, single blanks, %.9f times.  Where the heading is not
/// known, the quaternion is 0 0 0 0, which loadTum() reads back as unknown.
[[nodiscard]] eval::Trajectory loadTum(const std::string& path);
void saveTum(const std::string& path, const eval::Trajectory& trajectory);
}  // namespace slamot::results
