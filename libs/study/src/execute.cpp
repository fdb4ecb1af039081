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
  TrialResult result = runTrial(trial, bound);
  record.metrics = std::move(result.metrics);
  record.curves = std::move(result.curves);
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

/// One run of one of the jobs.
struct Task
{
  std::size_t job = 0;
  Run run;
  double share = 0;  ///< of the job's seeds, those before this one
};

/// The runs of a job's shard that are still to be done.
void addMissing(const std::vector<Job>& jobs, std::size_t job, const ExecuteOptions& options,
                ExecuteResult& result, std::vector<Task>& out)
{
  const Plan& plan = *jobs[job].plan;
  const auto shards = static_cast<std::size_t>(options.shards);
  for (std::size_t i = static_cast<std::size_t>(options.shard) % shards; i < plan.runs.size();
       i += shards)
  {
    ++result.runs;
    RunRecord record;
    const RecordState state = loadRecord(jobs[job].folder, plan, plan.runs[i], record);
    if (state == RecordState::kStale || state == RecordState::kDamaged) ++result.stale;
    if (state == RecordState::kGood && record.error.empty())
      ++result.found;
    else
      out.push_back({job, plan.runs[i],
                     static_cast<double>(plan.runs[i].seed - plan.spec.firstSeed) /
                         static_cast<double>(plan.spec.seeds)});
  }
}

/// All that is still to be done, seed by seed: what is there after an interruption then compares
/// methods on equal seeds.
std::vector<Task> missingTasks(const std::vector<Job>& jobs, const ExecuteOptions& options,
                               std::vector<ExecuteResult>& results)
{
  std::vector<Task> out;
  for (std::size_t j = 0; j < jobs.size(); ++j) addMissing(jobs, j, options, results[j], out);
  std::stable_sort(out.begin(), out.end(),
                   [](const Task& a, const Task& b) { return a.share < b.share; });
  return out;
}

/// Threads that take one run after another.
class Crew
{
 public:
  Crew(const std::vector<Job>& jobs, const ExecuteOptions& options, std::vector<Task> tasks,
       std::vector<ExecuteResult>& results)
      : jobs_(jobs), options_(options), tasks_(std::move(tasks)), results_(results)
  {
  }

  void work()
  {
    std::vector<std::thread> threads;
    const auto count =
        std::min<std::size_t>(static_cast<std::size_t>(options_.threads), tasks_.size());
    for (std::size_t i = 1; i < count; ++i) threads.emplace_back([this] { takeRuns(); });
    takeRuns();
    for (std::thread& thread : threads) thread.join();
    if (broken_) std::rethrow_exception(broken_);
  }

 private:
  void takeRuns()
  {
    while (!(options_.stop && options_.stop->load()))
    {
      const std::size_t i = next_++;
      if (i >= tasks_.size()) return;
      try
      {
        const Task& task = tasks_[i];
        const Job& job = jobs_[task.job];
        const RunRecord record = executeRun(*job.plan, task.run, bounds_);
        saveRecord(job.folder, *job.plan, task.run, record);
        note(results_[task.job], record);
      }
      catch (...)
      {
        const std::lock_guard<std::mutex> lock(mutex_);
        broken_ = std::current_exception();
        next_ = tasks_.size();
        return;
      }
    }
  }

  void note(ExecuteResult& result, const RunRecord& record)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ++done_;
    ++result.made;
    if (!record.error.empty())
    {
      ++failed_;
      if (result.failed++ == 0) result.firstFailed = record;
    }
    if (options_.onProgress) options_.onProgress(done_, tasks_.size(), failed_);
  }

  const std::vector<Job>& jobs_;
  const ExecuteOptions& options_;
  std::vector<Task> tasks_;
  std::vector<ExecuteResult>& results_;
  BoundCache bounds_;
  std::atomic<std::size_t> next_{0};
  std::mutex mutex_;
  std::size_t done_ = 0, failed_ = 0;
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
  return execute(std::vector<Job>{{&plan, folder}}, options).front();
}

std::vector<ExecuteResult> execute(const std::vector<Job>& jobs, const ExecuteOptions& options)
{
  std::vector<ExecuteResult> results(jobs.size());
  const auto tasks = missingTasks(jobs, options, results);
  Crew(jobs, options, tasks, results).work();
  for (ExecuteResult& r : results) r.interrupted = r.found + r.made < r.runs;
  return results;
}
}  // namespace slamot::study
