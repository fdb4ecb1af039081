#pragma once

#include <slamot/math/random.h>
#include <slamot/sim/Motion.h>

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

  void move(double dt, math::RandomStream& random);
  /// Where it is, and the direction it moves in.
  [[nodiscard]] Pose2D pose() const { return {at_.x, at_.y, direction()}; }

  /// The faster of the two springs' rates f [rad/s].
  [[nodiscard]] static double springRate(const Motion& motion);

 private:
  struct Spring
  {
    Spring(double noise, double limit);
    /// By a time h, with a standard normal deviate.
    void move(double h, double normal);
    /// x, bent into (-limit, limit).
    [[nodiscard]] double value() const { return limit * std::tanh(x / limit); }

    double noise, limit, rate;
    double x = 0, speed = 0;
  };
  [[nodiscard]] double direction() const { return math::wrapToPi(start_.phi + turn_.value()); }
  [[nodiscard]] Vector2 velocity() const;

  double speed0_;
  Pose2D start_;
  Point2D at_;
  Spring pace_, turn_;
};
}  // namespace slamot::sim
