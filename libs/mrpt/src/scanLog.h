#pragma once

#include "StepAssembler.h"

#include <optional>
#include <string>

namespace slamot::mrpt
{
/// A first pass over all of a rawlog.
struct LogScan
{
  LogFacts facts;                    ///< of what could be read
  std::optional<core::Error> error;  ///< why there is no more
};

/// \param onEntry is shown every entry, \param onStep every step.
[[nodiscard]] LogScan scanLog(const std::string& path, const RawlogSource::Options& options,
                              const std::function<void(const Entry&)>& onEntry = {},
                              const std::function<void(const core::Step&)>& onStep = {});

/// Whether the log gives increments but no covariance.
[[nodiscard]] bool lacksCovariance(const LogFacts& facts);

/// The [start] section of the log's comment text, with the time of a log's first entry, if that is
/// at rest, where the section has none.  \throws core::Error (kConfig) on a malformed section.
[[nodiscard]] core::Starts startsOf(const LogFacts& facts, const std::string& path);
}  // namespace slamot::mrpt
