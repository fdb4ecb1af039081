#pragma once

#include <slamot/core/Estimate.h>
#include <slamot/core/Params.h>
#include <slamot/core/Start.h>

#include <memory>

namespace slamot::filters::rbpf
{
/// Follows targets from poses that somebody else estimates: one EKF a target, in the frame of those
/// poses, with the same models, gates and rules as a particle has.  What the poses lack in
/// certainty is added to what is reported, not to the sightings' noise: a pose's error lasts, and
/// taken for noise it would only make the EKF slow.
class TargetFollower
{
 public:
  virtual ~TargetFollower() = default;
  static std::unique_ptr<TargetFollower> make(core::Params& params, const core::Starts& starts);

  /// Takes in a step: time goes on by dt [s], then the blobs seen from the pose.
  virtual void process(const core::Step& step, double dt, const Pose2D& pose) = 0;
  /// The confirmed targets, in rising order of ids, for a pose of this covariance.
  [[nodiscard]] virtual std::vector<core::TargetEstimate> estimates(
      const Gaussian<Pose2D>& pose) const = 0;
  /// What became of the last step's blobs.
  [[nodiscard]] virtual const std::vector<core::Pairing>& pairings() const = 0;
};
}  // namespace slamot::filters::rbpf
