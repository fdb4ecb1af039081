#pragma once

#include <slamot/eval/Record.h>

#include <string>

namespace slamot::apps
{
/// Writes map.simplemap and grid.png into a folder, if the run read laser scans.
void saveLaserMaps(const std::string& folder, const eval::Record& record);
}  // namespace slamot::apps
