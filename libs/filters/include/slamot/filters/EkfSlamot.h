#pragma once

#include <slamot/core/FilterRegistry.h>
#include <slamot/core/Team.h>

namespace slamot::filters
{
/// EKF-SLAMOT: one Gaussian with full covariance over the robot, any number of targets and all
/// landmarks; all sightings of a scan update it in one batch.  With `local_radius_m` in the
/// compressed form (Guivant and Nebot 2001): the same numbers but for rounding, at a cost per step
/// that does not depend on the map.  It does not derive from MRPT's CKalmanFilterCapable, which
/// updates densely; doc/speed.md has the comparison.
class EkfSlamot : public core::TeamFilter
{
 public:
  /// Section `ekf-slamot`, or `slamot` with its defaults. \throws core::Error (kConfig)
  EkfSlamot(core::Params& params, const core::FilterContext& context);
  ~EkfSlamot() override;

  core::Update process(const core::Step& step) override;
  [[nodiscard]] core::Estimate estimate() const override;

  [[nodiscard]] core::RobotAndTarget robotAndTarget(int target) const override;
  core::Fusion fuse(const core::Evidence& evidence, const core::FusionOptions& options) override;
  void predictTarget(core::RobotAndTarget& other, double dt) const override;

  class Engine;

 private:
  std::unique_ptr<Engine> engine_;
};

/// One EKF over all robots of a team, the targets and one map: what the best fusion could come to.
/// Robots see each other as blobs of `mateLabel`.  Steps come in the order of their times.
class CentralizedEkf
{
 public:
  /// \param params of section [ekf-slamot]; contexts of the robots, by number
  CentralizedEkf(core::Params& params, const std::vector<core::FilterContext>& contexts,
                 const std::string& mateLabel, const std::vector<int>& mateIds);
  ~CentralizedEkf();

  /// A step of the robot of this index. \throws core::Error as core::Filter::process()
  core::Update process(int robot, const core::Step& step);
  /// What is believed now, as of the robot of this index: the others are none of its targets.
  [[nodiscard]] core::Estimate estimate(int robot) const;

 private:
  std::unique_ptr<EkfSlamot::Engine> engine_;
};
}  // namespace slamot::filters
