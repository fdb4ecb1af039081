#pragma once

#include <slamot/core/FilterRegistry.h>

// What the joint filter is compared with, on the same data and with the same care.
namespace slamot::filters
{
namespace rbpf
{
class TargetFollower;
}

/// `odometry`: dead reckoning, and targets followed from its pose.
class OdometryTarget : public core::Filter
{
 public:
  /// Section `odometry`. \throws core::Error (kConfig)
  OdometryTarget(core::Params& params, const core::FilterContext& context);
  ~OdometryTarget() override;
  core::Update process(const core::Step& step) override;
  [[nodiscard]] core::Estimate estimate() const override { return estimate_; }

 private:
  std::unique_ptr<rbpf::TargetFollower> follower_;
  core::Estimate estimate_;
};

/// `true-pose-target`: targets followed from the robot's true pose; the bound for every other
/// filter's targets.  \throws core::Error (kConfig) without a true pose.
class TruePoseTarget : public core::Filter
{
 public:
  /// Section `true-pose-target`. \throws core::Error (kConfig), also without
  /// FilterContext::truePose
  TruePoseTarget(core::Params& params, const core::FilterContext& context);
  ~TruePoseTarget() override;
  /// \throws core::Error (kNonsense) where a blob was seen and the true pose isn't known.
  core::Update process(const core::Step& step) override;
  [[nodiscard]] core::Estimate estimate() const override { return estimate_; }

 private:
  std::function<std::optional<Pose2D>(double)> truePose_;
  std::unique_ptr<rbpf::TargetFollower> follower_;
  core::Estimate estimate_;
};

/// `independent`: the same particle filter for SLAM alone, and targets followed from its mean pose.
class Independent : public core::Filter
{
 public:
  /// Section `independent`, with the keys of `rbpf-slamot`. \throws core::Error (kConfig)
  Independent(core::Params& params, const core::FilterContext& context);
  ~Independent() override;
  core::Update process(const core::Step& step) override;
  [[nodiscard]] core::Estimate estimate() const override { return estimate_; }
  [[nodiscard]] std::vector<core::WeightedPose> particles() const override
  {
    return slam_->particles();
  }

 private:
  std::unique_ptr<core::Filter> slam_;
  std::unique_ptr<rbpf::TargetFollower> follower_;
  core::Estimate estimate_;
};
}  // namespace slamot::filters
