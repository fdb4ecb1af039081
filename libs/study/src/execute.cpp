#include <slamot/study/execute.h>

#include <slamot/core/Error.h>
#include <slamot/study/Metrics.h>
#include <slamot/study/Trial.h>

#include <ctime>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <mutex>
#include <new>
#include <thread>

#include "BoundCache.h"

namespace slamot::study
{
namespace
{
double threadCpuS()
{
  timespec t{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double wallS()
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Adds what something takes to a record's times.
class Stopwatch
{
 public:
  explicit Stopwatch(RunRecord& record) : record_(record) {}
  ~Stopwatch()
  {
    record_.cpuS += threadCpuS() - cpuS_;
    record_.wallS += wallS() - wallS_;
  }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  RunRecord& record_;
  double cpuS_ = threadCpuS(), wallS_ = wallS();
};

void measureRun(const Plan& plan, const Run& run, BoundCache& bounds, RunRecord& record)
{
  const Group& group = plan.groups[run.group];
  const auto open = [&]
  {
    const Stopwatch watch(record);
    return openTrial(plan.spec, plan.cells[group.cell], plan.spec.methods[group.method], run.seed);
  };
  Trial trial = open();
  // The bound is not the method's: it is in no method's time.
  const auto bound = bounds.of(trial);
  const Stopwatch watch(record);
  record.metrics = runTrial(trial, bound);
  for (std::size_t i = 0; i < record.metrics.size(); ++i)
    if (record.metrics[i] && !std::isfinite(*record.metrics[i]))
      throw core::Error(core::ExitStatus::kInternal, metrics()[i].name, "is not finite");
}

void fail(RunRecord& record, core::ExitStatus status, const std::string& why)
{
  record.metrics.clear();
  record.error = why;
  record.status = static_cast<int>(status);
}

RunRecord executeRun(const Plan& plan, const Run& run, BoundCache& bounds)
{
  RunRecord record;
  record.hash = plan.groups[run.group].hash;
  record.seed = run.seed;
  try
  {
    measureRun(plan, run, bounds, record);
  }
  catch (const core::Error& e)
  {
    fail(record, e.status(), e.what());
  }
  catch (const std::bad_alloc&)
  {
    fail(record, core::ExitStatus::kLimit, "memory: exhausted");
  }
  catch (const std::exception& e)
  {
    fail(record, core::ExitStatus::kInternal, e.what());
  }
  return record;
}

/// The runs of a shard that are still to be done, seed by seed: what is there after an interruption
/// then compares methods on equal seeds.
std::vector<Run> missingRuns(const Plan& plan, const std::string& folder,
                             const ExecuteOptions& options, ExecuteResult& result)
{
  std::vector<Run> out;
  const auto shards = static_cast<std::size_t>(options.shards);
  for (std::size_t i = static_cast<std::size_t>(options.shard) % shards; i < plan.runs.size();
       i += shards)
  {
    ++result.runs;
    RunRecord record;
    const RecordState state = loadRecord(folder, plan, plan.runs[i], record);
    if (state == RecordState::kStale || state == RecordState::kDamaged) ++result.stale;
    if (state == RecordState::kGood && record.error.empty())
      ++result.found;
    else
      out.push_back(plan.runs[i]);
  }
  std::stable_sort(out.begin(), out.end(),
                   [](const Run& a, const Run& b) { return a.seed < b.seed; });
  return out;
}

/// Threads that take one run after another.
class Crew
{
 public:
  Crew(const Plan& plan, const std::string& folder, const ExecuteOptions& options,
       std::vector<Run> runs)
      : plan_(plan), folder_(folder), options_(options), runs_(std::move(runs))
  {
  }

  void work(ExecuteResult& result)
  {
    std::vector<std::thread> threads;
    const auto count =
        std::min<std::size_t>(static_cast<std::size_t>(options_.threads), runs_.size());
    for (std::size_t i = 1; i < count; ++i) threads.emplace_back([this] { takeRuns(); });
    takeRuns();
    for (std::thread& thread : threads) thread.join();
    if (broken_) std::rethrow_exception(broken_);
    result.made = done_;
    result.failed = failed_;
    result.firstFailed = firstFailed_;
  }

 private:
  void takeRuns()
  {
    while (!(options_.stop && options_.stop->load()))
    {
      const std::size_t i = next_++;
      if (i >= runs_.size()) return;
      try
      {
        const RunRecord record = executeRun(plan_, runs_[i], bounds_);
        saveRecord(folder_, plan_, runs_[i], record);
        const std::lock_guard<std::mutex> lock(mutex_);
        ++done_;
        if (!record.error.empty() && failed_++ == 0) firstFailed_ = record;
        if (options_.onProgress) options_.onProgress(done_, runs_.size(), failed_);
      }
      catch (...)
      {
        const std::lock_guard<std::mutex> lock(mutex_);
        broken_ = std::current_exception();
        next_ = runs_.size();
        return;
      }
    }
  }

  const Plan& plan_;
  const std::string& folder_;
  const ExecuteOptions& options_;
  std::vector<Run> runs_;
  BoundCache bounds_;
  std::atomic<std::size_t> next_{0};
  std::mutex mutex_;
  std::size_t done_ = 0, failed_ = 0;
  std::optional<RunRecord> firstFailed_;
  std::exception_ptr broken_;
};
}  // namespace

RunRecord executeRun(const Plan& plan, const Run& run)
{
  BoundCache bounds;
  return executeRun(plan, run, bounds);
}

ExecuteResult execute(const Plan& plan, const std::string& folder, const ExecuteOptions& options)
{
  ExecuteResult result;
  const auto runs = missingRuns(plan, folder, options, result);
  const std::size_t missing = runs.size();
  Crew(plan, folder, options, runs).work(result);
  result.interrupted = result.made < missing;
  return result;
}
}  // namespace slamot::study
