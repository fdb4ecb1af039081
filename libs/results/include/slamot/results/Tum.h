#pragma once

#include <slamot/eval/Trajectory.h>

#include <string>

namespace slamot::results
{
/// Reads the TUM format: `timestamp x y z qx qy qz qw` [s, m], times rising strictly; z, roll and
/// pitch are left out.  A quaternion of 0 0 0 0 means that the heading is not known.  Lines that
/// are empty or start with # are skipped; blanks and tabs separate.
/// \throws core::Error (kUnreadable, kTruncated, kNonsense, kLimit) with the line.
[[nodiscard]] eval::Trajectory loadTum(const std::string& path);

/// Writes it: eight fields, single blanks, times with nine decimals; whole or not at all.
/// \throws core::Error: kUnreadable if the file can't be written; kInternal on a value that is not
/// finite or times that do not rise in what is printed.
void saveTum(const std::string& path, const eval::Trajectory& trajectory);
}  // namespace slamot::results
