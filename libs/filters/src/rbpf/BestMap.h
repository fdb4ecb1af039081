#pragma once

#include "LandmarkScan.h"
#include "MapFrame.h"

#include <slamot/core/Estimate.h>

namespace slamot::filters::rbpf
{
/// The heaviest particle's map, as the estimate shows it.
class BestMap : public core::LandmarkView
{
 public:
  BestMap(const Settings& settings, const LandmarkScan& scan) : settings_(settings), scan_(scan) {}
  void visit(const std::function<void(const core::LandmarkEstimate&)>& visitor) const override;
  [[nodiscard]] std::size_t size() const override;

  maps::LandmarkMap map;
  Pose2D shift;  ///< its particle's, see Particle
  MapFrame frame;

 private:
  [[nodiscard]] bool isShown(const maps::Landmark& m) const;
  const Settings& settings_;
  const LandmarkScan& scan_;
};
}  // namespace slamot::filters::rbpf
