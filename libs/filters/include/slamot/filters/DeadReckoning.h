#pragma once

#include <slamot/core/FilterRegistry.h>

namespace slamot::filters
{
/// Odometry summed up, its covariance to first order; no map, no targets.  The simplest filter: it
/// proves the pipeline and is the first row of every table.
class DeadReckoning : public core::Filter
{
 public:
  /// Section `dead-reckoning`, which has no keys.
  DeadReckoning(core::Params& params, const core::FilterContext& context);

  core::Update process(const core::Step& step) override;
  [[nodiscard]] core::Estimate estimate() const override { return estimate_; }

 private:
  core::Estimate estimate_;
};
}  // namespace slamot::filters
