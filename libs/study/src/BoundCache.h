#pragma once

#include <slamot/study/Trial.h>

#include <future>
#include <map>
#include <mutex>
#include <string>

namespace slamot::study
{
/// Bounds of worlds, which all methods share: each is computed once, by the thread that asks first.
class BoundCache
{
 public:
  /// Of the trial's world; none without one.  \throws core::Error as the computation.
  [[nodiscard]] std::optional<BoundFigures> of(const Trial& trial);

 private:
  using Figures = std::optional<BoundFigures>;
  std::mutex mutex_;
  std::map<std::string, std::shared_future<Figures>> known_;
};
}  // namespace slamot::study
