#pragma once

#include <slamot/core/Team.h>
#include <slamot/math/intersection.h>

namespace slamot::filters
{
/// The intersection that a rule stands for; covariance intersection for those that are none.
inline math::Intersection intersectionOf(core::FusionRule rule)
{
  switch (rule)
  {
    case core::FusionRule::kSplitCi:
      return math::Intersection::kSplit;
    case core::FusionRule::kIci:
      return math::Intersection::kInverse;
    default:
      return math::Intersection::kCovariance;
  }
}
}  // namespace slamot::filters
