#pragma once

#include <slamot/core/Filter.h>

#include <atomic>
#include <functional>

namespace slamot::core
{
/// Where steps come from.
class Source
{
 public:
  virtual ~Source() = default;
  /// The next step; none at the end.  \throws Error on input that can't be used.
  virtual std::optional<Step> next() = 0;
  /// Share of the input already delivered, 0 to 1.
  [[nodiscard]] virtual double progress() const { return 0; }
};

/// Where steps and what was believed after them go.
class Sink
{
 public:
  virtual ~Sink() = default;
  /// The belief before the first step.
  virtual void begin(const Estimate&) {}
  /// A step, and what the filter made of it.
  virtual void accept(const Step& step, const Update& update) = 0;
  /// The end; `complete` is false if the run was interrupted or its input ended too early.
  virtual void finish(bool complete) = 0;
};

/// What a caller may do while run() goes on.
struct RunOptions
{
  const std::atomic<bool>* stop =
      nullptr;  ///< ends the run at a step's boundary when it turns true
  std::function<void(std::size_t steps, double progress)>
      onProgress;  ///< called after every step; progress from 0 to 1
};

/// How run() ended.
struct RunResult
{
  std::size_t steps = 0;     ///< that the filter took in
  bool interrupted = false;  ///< by RunOptions::stop
};

/// The pipeline: every step of the source through the filter, into every sink.
/// On an exception the sinks that began are finished as incomplete, and it goes on to the caller.
RunResult run(Source& source, Filter& filter, const std::vector<Sink*>& sinks,
              const RunOptions& options = {});
}  // namespace slamot::core
