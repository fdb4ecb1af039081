#include "studyOptions.h"

#include <slamot/core/Error.h>

#include <cstdio>

namespace slamot::apps
{
using core::Error;
using core::ExitStatus;

void readShard(const std::string& text, study::ExecuteOptions& options)
{
  char rest = 0;
  const int read = std::sscanf(text.c_str(), "%d/%d%c", &options.shard, &options.shards, &rest);
  if (read != 2 || options.shards < 1 || options.shard < 1 || options.shard > options.shards)
    throw Error(ExitStatus::kConfig, "--shard " + text, "is not I/N with I from 1 to N",
                "write --shard 1/8 to --shard 8/8");
}

void noteStale(std::size_t count, const char* what)
{
  if (count > 0)
    std::fprintf(stderr, "slamot: %zu record%s of another spec or version, or damaged: %s\n", count,
                 count == 1 ? "" : "s", what);
}

void failRuns(const std::string& folder, std::size_t failed, std::size_t of,
              const study::RunRecord& first, const char* again)
{
  throw Error(static_cast<ExitStatus>(first.status), folder,
              std::to_string(failed) + " of " + std::to_string(of) +
                  " runs failed, one of them, seed " + std::to_string(first.seed) +
                  ", with: " + first.error,
              std::string("mend that and ") + again + ": it does what is missing");
}
}  // namespace slamot::apps
