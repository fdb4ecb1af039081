#pragma once

#include <slamot/study/RunRecord.h>

#include <atomic>
#include <functional>

namespace slamot::study
{
/// Who does which runs.
struct ExecuteOptions
{
  int threads = 1;  ///< each does one run at a time
  int shard = 0;    ///< takes the runs whose number has the remainder shard % shards
  int shards = 1;   ///< how many such shares there are
  const std::atomic<bool>* stop = nullptr;  ///< when it turns true, runs under way are the last
  /// After every run, one call at a time: runs done and to be done, failed ones so far.
  std::function<void(std::size_t done, std::size_t of, std::size_t failed)> onProgress;
};

/// What was done.
struct ExecuteResult
{
  std::size_t runs = 0;                  ///< of this shard
  std::size_t found = 0;                 ///< already there
  std::size_t stale = 0;                 ///< there, but of another spec or damaged: made anew
  std::size_t made = 0;                  ///< runs of this call
  std::size_t failed = 0;                ///< of those made
  std::optional<RunRecord> firstFailed;  ///< to say why
  bool interrupted = false;              ///< by ExecuteOptions::stop
};

/// Does those runs of a study that have no good record in its folder, or failed, each in one
/// thread.  A run that throws is recorded as failed, and the others go on.
/// \throws core::Error (kUnreadable) if a record can't be written.
ExecuteResult execute(const Plan& plan, const std::string& folder, const ExecuteOptions& options);

/// A study to be done, and the folder of its records.
struct Job
{
  const Plan* plan = nullptr;  ///< never null
  std::string folder;          ///< where its records are
};

/// The same for several studies at once, with one crew of threads.  All go forward together, seed
/// by seed, so that what is left takes as long as it seems to.
/// \return one result for each job
std::vector<ExecuteResult> execute(const std::vector<Job>& jobs, const ExecuteOptions& options);

/// One run.
[[nodiscard]] RunRecord executeRun(const Plan& plan, const Run& run);
}  // namespace slamot::study
