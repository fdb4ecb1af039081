#pragma once

#include <tbb/blocked_range.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>

#ifdef __SANITIZE_THREAD__
#include <sanitizer/tsan_interface.h>
#endif

namespace slamot::filters::rbpf
{
// What TBB guarantees, told to the thread sanitizer, which does not see into TBB: what comes before
// a loop happens before its parts, and these before what comes after it.
inline void handOver([[maybe_unused]] void* what)
{
#ifdef __SANITIZE_THREAD__
  __tsan_release(what);
#endif
}
inline void takeOver([[maybe_unused]] void* what)
{
#ifdef __SANITIZE_THREAD__
  __tsan_acquire(what);
#endif
}

/// Runs f(i, lane) for i in [0, n) on some threads; a lane is used by one thread at a time.
/// Results must not depend on the lane, so that they don't on the number of threads.
class Workers
{
 public:
  /// As many threads as asked for, but no more than there are cores: TBB would warn and not do it.
  explicit Workers(int threads)
      : threads_(std::max(1, std::min(threads, tbb::info::default_concurrency()))), arena_(threads_)
  {
  }
  [[nodiscard]] int lanes() const { return threads_; }

  template <class F>
  void forEach(std::size_t n, F&& f)
  {
    if (threads_ == 1)
    {
      for (std::size_t i = 0; i < n; ++i) f(i, 0);
      return;
    }
    constexpr std::size_t kGrain = 16;
    handOver(&begun_);
    arena_.execute(
        [&]
        {
          tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n, kGrain),
                            [&](const tbb::blocked_range<std::size_t>& r)
                            {
                              takeOver(&begun_);
                              const int lane = tbb::this_task_arena::current_thread_index();
                              for (std::size_t i = r.begin(); i < r.end(); ++i) f(i, lane);
                              handOver(&ended_);
                            });
        });
    takeOver(&ended_);
  }

 private:
  int threads_;
  char begun_ = 0, ended_ = 0;  // only their addresses matter
  tbb::task_arena arena_;
};
}  // namespace slamot::filters::rbpf
