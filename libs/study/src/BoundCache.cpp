#include "BoundCache.h"

namespace slamot::study
{
std::optional<BoundFigures> BoundCache::of(const Trial& trial)
{
  if (!trial.bound) return std::nullopt;
  std::packaged_task<Figures()> task(trial.bound);
  std::shared_future<Figures> figures;
  bool isFirst = false;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    auto& known = known_[trial.world];
    isFirst = !known.valid();
    if (isFirst) known = task.get_future().share();
    figures = known;
  }
  if (isFirst) task();
  return figures.get();
}
}  // namespace slamot::study
