#pragma once

#include <slamot/core/FilterRegistry.h>
#include <slamot/moving/MovingObjects.h>
#include <slamot/scans/OdometryShare.h>
#include <slamot/scans/ScanSlam.h>

#include <optional>

namespace slamot::scans
{
/// `scan-slamot`: the robot's pose and path by odometry and laser scans, as `scan-slam`, and what
/// moves in the scans followed by laser alone.  Beams that meet what moves are neither matched nor
/// kept, and what moves is seen from where the scan was matched.  With `ego = odometry` the robot
/// goes by dead reckoning.
class ScanSlamotFilter : public core::Filter
{
 public:
  /// Section `scan-slamot`, which has all keys of `scan-slam` too. \throws core::Error (kConfig)
  ScanSlamotFilter(core::Params& params, const core::FilterContext& context);

  core::Update process(const core::Step& step) override;
  [[nodiscard]] core::Estimate estimate() const override { return estimate_; }
  /// Empty with `ego = odometry`.
  [[nodiscard]] std::vector<core::PathPose> path() const override;

 private:
  void moveBy(const core::Step& step, double dt);
  void matchStanding(const std::vector<Return>& returns, const core::Step& step);

  Settings settings_;
  std::optional<ScanSlam> slam_;  // none: dead reckoning
  moving::MovingObjects objects_;
  OdometryShare share_;
  double blind_ = 0;  // time without odometry or a match [s]
  core::Estimate estimate_;
};
}  // namespace slamot::scans
