#pragma once

#include <slamot/eval/Record.h>

#include <string>

namespace slamot::apps
{
/// Writes the maps of the run's laser scans into a folder, if it read any: drawn from the filter's
/// estimates, and in path/ from the path it believed at the end, if it keeps one.
void saveLaserMaps(const std::string& folder, const eval::Record& record);

/// Reads a result folder's laser scans back, each for the row of its time.
/// \throws core::Error on a map that can't be used.
void loadLasers(const std::string& folder, eval::Record& record);
}  // namespace slamot::apps
