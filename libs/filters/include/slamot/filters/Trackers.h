#pragma once

#include <slamot/core/FilterRegistry.h>

// Filters for targets alone, by blobs from a robot that odometry places: no map is made, and what
// the robot's pose lacks in certainty is added to what is reported.
namespace slamot::filters
{
namespace trackers
{
class Follower;
}

/// What trackers share: the robot by dead reckoning, and targets followed from its mean pose.
class Tracker : public core::Filter
{
 public:
  ~Tracker() override;
  core::Update process(const core::Step& step) override;
  [[nodiscard]] core::Estimate estimate() const override { return estimate_; }

 protected:
  /// `follower` keeps the targets.
  Tracker(const core::FilterContext& context, std::unique_ptr<trackers::Follower> follower);

 private:
  std::unique_ptr<trackers::Follower> follower_;
  core::Estimate estimate_;
};

/// `particle-tracker`: a bootstrap particle filter for each target (Gordon, Salmond, Smith 1993),
/// with constant velocity but for white acceleration, and weights w^alpha p(z | x) from blobs whose
/// errors are normal or glint.  Zhu and Jin 2018.  Built on MRPT's particle filter classes.
class ParticleTracker : public Tracker
{
 public:
  /// Section `particle-tracker`. \throws core::Error (kConfig)
  ParticleTracker(core::Params& params, const core::FilterContext& context);
};

/// `kalman-tracker`: an EKF for each target, or, where blobs count as places, a Kalman filter.
/// With errors that glint its update is that by all Gaussians of their law together, each with its
/// share: an interacting multiple model filter over the noises of the observation whose modes have
/// no memory, since an outlier tells nothing of the next.  `imm-tracker` is the same, with such a
/// law unless the configuration says otherwise.
class KalmanTracker : public Tracker
{
 public:
  /// Section `kalman-tracker` or `imm-tracker`. \throws core::Error (kConfig)
  KalmanTracker(core::Params& params, const core::FilterContext& context);
};
}  // namespace slamot::filters
