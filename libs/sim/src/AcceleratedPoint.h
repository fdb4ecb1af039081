#pragma once

#include <slamot/math/random.h>
#include <slamot/sim/Scenario.h>

namespace slamot::sim
{
/// A point whose jerk is white noise, and which never turns back.
///
/// Its speed is s0 + B tanh(x / B) and its direction d0 + C tanh(y / C): inside a band and a cone,
/// always, and without kinks.  x and y are driven by the jerk and drawn back by a damped spring:
/// x'' = q w - 2 zeta f x' - f² x, and y the same with q / s0, so that both shake the point's
/// acceleration by q in the middle of the band, and by less near its edges.  The spring is as weak
/// as it can be with a third of the band as x's standard deviation in the long run:
/// f³ = q² / (4 zeta (B/3)²).  What it adds to the acceleration over a time t is sqrt(1.06 f t) of
/// what the jerk adds: over times well below 1 / f the acceleration is a random walk of density q.
class AcceleratedPoint
{
 public:
  /// Starts with the motion's speed in the start's direction, without acceleration.
  AcceleratedPoint(const Motion& motion, const Pose2D& start);

  /// Coordinates of its state: place (x, y) [m]; x and x' of its pace [m/s, m/s²]; y and y' of its
  /// turn [rad, rad/s].
  static constexpr int kSize = 6;
  /// How small differences of the state go on over a move: to F d + w, w of covariance Q; and the w
  /// that was drawn.
  struct Linear
  {
    Eigen::Matrix<double, kSize, 1> w = Eigen::Matrix<double, kSize, 1>::Zero();
    Eigen::Matrix<double, kSize, kSize> F = Eigen::Matrix<double, kSize, kSize>::Identity();
    Eigen::Matrix<double, kSize, kSize> Q = Eigen::Matrix<double, kSize, kSize>::Zero();
  };

  /// \param linear the move's, about the motion drawn; not if null.
  void move(double dt, math::RandomStream& random, Linear* linear = nullptr);
  /// Where it is, and the direction it moves in.
  [[nodiscard]] Pose2D pose() const { return {at_.x, at_.y, direction()}; }
  [[nodiscard]] Vector2 velocity() const;

  /// The faster of the two springs' rates f [rad/s].
  [[nodiscard]] static double springRate(const Motion& motion);

  /// What is known of its state at the start by what a filter is told: deviations in the state's
  /// order.  What is not told is as uncertain as in the long run.
  [[nodiscard]] Eigen::Matrix<double, kSize, 1> startStd(const StartKnowledge& knowledge) const;

 private:
  struct Spring
  {
    Spring(double noise, double limit);
    /// By a time h, with a standard normal deviate.
    void move(double h, double normal);
    /// x, bent into (-limit, limit).
    [[nodiscard]] double value() const { return limit * std::tanh(x / limit); }
    /// Its derivative by x.
    [[nodiscard]] double slope() const { return 1 - std::pow(value() / limit, 2); }
    /// Derivative of (x, speed) after a move by h, by those before; and by the deviate.
    [[nodiscard]] Matrix2 transition(double h) const;
    [[nodiscard]] Vector2 gain(double h) const;
    /// Standard deviations of x and speed in the long run.
    [[nodiscard]] Vector2 longRun() const { return {limit / 3, rate * limit / 3}; }

    double noise, limit, rate;
    double x = 0, speed = 0;
  };
  /// By a part of a move, after it; with the velocity's derivative before it, and its deviates.
  void extend(Linear& linear, double h, const Eigen::Matrix<double, 2, kSize>& before,
              const Vector2& deviates) const;
  [[nodiscard]] double direction() const { return math::wrapToPi(start_.phi + turn_.value()); }
  [[nodiscard]] Eigen::Matrix<double, 2, kSize> velocityJacobian() const;

  double speed0_;
  Pose2D start_;
  Point2D at_;
  Spring pace_, turn_;
};
}  // namespace slamot::sim
