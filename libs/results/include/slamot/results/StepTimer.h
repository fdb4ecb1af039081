#pragma once

#include <slamot/core/run.h>
#include <slamot/results/Summary.h>

#include <chrono>

namespace slamot::results
{
/// Measures a run: wraps its source, and must be the first of its sinks, so that what lies between
/// is the filter.
class StepTimer : public core::Source, public core::Sink
{
 public:
  /// The clock runs from here on; `source` must outlive this.
  explicit StepTimer(core::Source& source);

  std::optional<core::Step> next() override;
  [[nodiscard]] double progress() const override { return source_->progress(); }
  void accept(const core::Step& step, const core::Update& update) override;
  void finish(bool) override {}

  /// From construction to now.
  [[nodiscard]] Timing timing() const;

 private:
  using Clock = std::chrono::steady_clock;
  core::Source* source_;
  Clock::time_point start_, stepStart_;
  double cpuAtStart_ = 0;       // [s]
  std::vector<float> stepsUs_;  // [us]
};
}  // namespace slamot::results
