#pragma once

#include <slamot/core/FilterRegistry.h>
#include <slamot/core/Team.h>

namespace slamot::filters
{
/// Rao-Blackwellised particle filter for SLAM and object tracking: each particle holds a pose, an
/// EKF for each landmark and one for each target.  Wu and Sun 2013, algorithm 1 as corrected; with
/// `proposal = informed`, the pose is drawn from the Gaussian that takes in the scan's landmarks
/// and targets (Montemerlo et al. 2003, FastSLAM 2.0).  Built on MRPT's particle filter classes.
/// In a team, what others tell moves each particle as a rigid whole and its target besides.
class RbpfSlamot : public core::TeamFilter
{
 public:
  /// Section `rbpf-slamot`, or `fastslam1`, `fastslam2`, `ufastslam`, `gmphd-ufastslam`: the name
  /// chooses the defaults. \throws core::Error (kConfig)
  RbpfSlamot(core::Params& params, const core::FilterContext& context);
  ~RbpfSlamot() override;

  core::Update process(const core::Step& step) override;
  [[nodiscard]] core::Estimate estimate() const override;
  [[nodiscard]] std::vector<core::WeightedPose> particles() const override;
  /// Of the heaviest particle; after a resampling, of one that comes of the heaviest before it.
  [[nodiscard]] std::vector<core::PathPose> path() const override;

  [[nodiscard]] core::RobotAndTarget robotAndTarget(int target) const override;
  /// \throws Error also before the first scan, when there is no map yet that could be moved.
  core::Fusion fuse(const core::Evidence& evidence, const core::FusionOptions& options) override;
  void predictTarget(core::RobotAndTarget& other, double dt) const override;

  /// Memory that the maps take [bytes].
  [[nodiscard]] std::size_t mapBytes() const;

  class Engine;

 private:
  std::unique_ptr<Engine> engine_;
};
}  // namespace slamot::filters
