#pragma once

#include <slamot/eval/ScanMap.h>

#include <string>

namespace slamot::apps
{
/// How sharp a map a log's laser scans make where a path has them.  Warns of scans that it has no
/// pose for.
/// \param result that the path is of: a folder's config tells how the log is read.
/// \throws core::Error where no scan has a pose, or the log can't be read.
[[nodiscard]] eval::ScanMapQuality scanMapAlong(const eval::Record& path, const std::string& rawlog,
                                                const std::string& result);
}  // namespace slamot::apps
