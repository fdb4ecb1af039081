#pragma once

#include <slamot/fusion/Message.h>

namespace slamot::fusion
{
/// A place that a sender saw, in map axes, with the sender's target where it has one: coordinates
/// x, y [m], then the target's.
struct SeenPlace
{
  Eigen::VectorXd mean;         ///< x, y [m], then the target's
  Eigen::MatrixXd cov;          ///< the sender's own errors and the sensor's
  Eigen::MatrixXd independent;  ///< the part of `cov` that is the sensor's noise
};

/// The place of a candidate, jointly with the first `targetSize` coordinates of the sender's
/// target: p = (x + d cos(theta + gamma), y + d sin(theta + gamma)), F P Fᵀ + F_z R F_zᵀ.
[[nodiscard]] SeenPlace placeOf(const Candidate& candidate, const core::RobotAndTarget& sender,
                                int targetSize);

/// Derivative of the place by the sender's pose: 2x3.
[[nodiscard]] Eigen::Matrix<double, 2, 3> placeByPose(const Candidate& candidate,
                                                      double senderHeading);
}  // namespace slamot::fusion
