#pragma once

#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservation.h>
#include <slamot/core/Step.h>

#include <vector>

namespace slamot::mrpt
{
/// What a step's sensors saw, as MRPT's observations: LANDMARKS, BLOBS, LASER0, LASER1, ...
[[nodiscard]] std::vector<::mrpt::obs::CObservation::Ptr> toObservations(const core::Step& step);

/// An odometry increment that keeps its covariance.  MRPT stores emOdometry as a motion model and
/// computes the covariance anew on load, so the estimation method is emScan2DMatching, which stores
/// it. \param dt [s] since the last step, for the velocities; absent or zero: none are set.
[[nodiscard]] ::mrpt::obs::CActionRobotMovement2D toAction(const Gaussian<Pose2D>& increment,
                                                           double time, std::optional<double> dt);

/// The increment's mean velocity [m/s, m/s, rad/s] over dt [s].
[[nodiscard]] ::mrpt::math::TTwist2D meanVelocity(const Pose2D& increment, double dt);
}  // namespace slamot::mrpt
