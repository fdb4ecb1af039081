#pragma once

#include <slamot/fusion/Message.h>

#include <optional>

namespace slamot::fusion
{
/// Sizes beyond which a value of a message is absurd.
struct MessageLimits
{
  double place = 1e7;             ///< [m], of coordinates
  double range = 1e5;             ///< [m], of a candidate
  double placeStd = 1e4;          ///< [m], of robot and target
  double headingStd = 10;         ///< [rad]
  double motionStd = 1e4;         ///< [m/s] and [m/s²]; also of their means
  double rangeStd = 1e3;          ///< [m]
  double bearingStd = math::kPi;  ///< [rad]
  double smallestStd = 1e-6;      ///< of target and candidates: a target so well known is a lie
};

/// What is wrong with the values of a message, if anything: kNotFinite, kAbsurd or
/// kNotPositiveDefinite.  The robot's part may be singular, as that of a robot whose start is known
/// exactly; the target's may not.  Only one triangle is sent, so that a covariance can't be
/// asymmetric.
[[nodiscard]] std::optional<Outcome> checkValues(const Message& message,
                                                 const MessageLimits& limits);

/// Whether a symmetric matrix is positive definite, whatever the units of its coordinates.
[[nodiscard]] bool positiveDefinite(const Eigen::Ref<const Eigen::MatrixXd>& cov);
}  // namespace slamot::fusion
