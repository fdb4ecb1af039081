#pragma once

#include <slamot/math/random.h>
#include <slamot/sim/Scenario.h>

namespace slamot::sim
{
/// A point whose acceleration is drawn anew each step, each axis of the map by itself, and constant
/// over it: x += v dt + a dt²/2, v += a dt.  Bar-Shalom, Li, Kirubarajan, "Estimation with
/// Applications to Tracking and Navigation", 2001, section 6.3.2.
class WhiteAccelerationPoint
{
 public:
  /// Starts with the motion's speed in the start's direction.
  WhiteAccelerationPoint(const Motion& motion, const Pose2D& start);

  /// Coordinates of its state: x, y [m], vx, vy [m/s].
  static constexpr int kSize = 4;
  using State = Eigen::Matrix<double, kSize, 1>;
  /// As AcceleratedPoint::Linear; exact.
  struct Linear
  {
    State w = State::Zero();
    Eigen::Matrix<double, kSize, kSize> F = Eigen::Matrix<double, kSize, kSize>::Identity();
    Eigen::Matrix<double, kSize, kSize> Q = Eigen::Matrix<double, kSize, kSize>::Zero();
  };

  /// \param linear the move's; not if null.
  void move(double dt, math::RandomStream& random, Linear* linear = nullptr);
  /// Where it is, and the direction it moves in.
  [[nodiscard]] Pose2D pose() const { return {x_[0], x_[1], std::atan2(x_[3], x_[2])}; }
  [[nodiscard]] Vector2 velocity() const { return x_.tail<2>(); }

  /// What is known of its state at the start by what a filter is told: deviations.
  [[nodiscard]] State startStd(const StartKnowledge& knowledge) const;

 private:
  double accelerationStd_;
  State x_;
};
}  // namespace slamot::sim
