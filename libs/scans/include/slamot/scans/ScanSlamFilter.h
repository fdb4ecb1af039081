#pragma once

#include <slamot/core/FilterRegistry.h>
#include <slamot/scans/OdometryShare.h>
#include <slamot/scans/ScanSlam.h>

namespace slamot::scans
{
/// `scan-slam`: the robot's pose and path by odometry and laser scans; no landmarks, no targets.
class ScanSlamFilter : public core::Filter
{
 public:
  /// Section `scan-slam`. \throws core::Error (kConfig)
  ScanSlamFilter(core::Params& params, const core::FilterContext& context);

  core::Update process(const core::Step& step) override;
  [[nodiscard]] core::Estimate estimate() const override { return estimate_; }
  [[nodiscard]] std::vector<core::PathPose> path() const override { return slam_.path(); }

  /// What the filter runs on: for tests of its parts.
  [[nodiscard]] const ScanSlam& slam() const { return slam_; }

 private:
  ScanSlamFilter(const Settings& settings, const core::FilterContext& context);

  double maxRange_;
  ScanSlam slam_;
  OdometryShare share_;
  core::Estimate estimate_;
};
}  // namespace slamot::scans
