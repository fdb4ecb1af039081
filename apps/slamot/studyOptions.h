#pragma once

#include <slamot/study/execute.h>

#include <string>

namespace slamot::apps
{
/// Reads I/N, I from 1 to N; 0 stands for N, so that arrays may count from either.
/// \throws core::Error (kConfig) on anything else.
void readShard(const std::string& text, study::ExecuteOptions& options);

/// Says on stderr that records were of another spec, if any were.
void noteStale(std::size_t count, const char* what);

/// Ends a command some of whose runs failed.  \throws core::Error with the status of the first.
[[noreturn]] void failRuns(const std::string& folder, std::size_t failed, std::size_t of,
                           const study::RunRecord& first, const char* again);
}  // namespace slamot::apps
