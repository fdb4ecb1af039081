#pragma once

#include <slamot/eval/Record.h>

#include <string>
#include <vector>

namespace slamot::results
{
/// Why a run that went well by itself is surely not what was wanted, and how to mend it, one
/// sentence each: sightings that were all rejected for want of an identity, blobs that never became
/// a target, a map without landmarks, a log with nothing to map.
/// \param method the section of the configuration that the keys named are in.
[[nodiscard]] std::vector<std::string> hintsOf(const eval::Record& record,
                                               const std::string& method);
}  // namespace slamot::results
