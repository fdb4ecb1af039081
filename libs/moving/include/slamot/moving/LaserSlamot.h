#pragma once

#include <slamot/core/FilterRegistry.h>
#include <slamot/core/Odometry.h>
#include <slamot/moving/MovingObjects.h>

namespace slamot::moving
{
/// Dead reckoning, and what moves followed by laser alone.
class LaserSlamot : public core::Filter
{
 public:
  LaserSlamot(core::Params& params, const core::FilterContext& context);
  core::Update process(const core::Step& step) override;
  [[nodiscard]] core::Estimate estimate() const override { return estimate_; }

 private:
  core::Estimate estimate_;
  MovingObjects objects_;
};
}  // namespace slamot::moving
