#pragma once

#include <slamot/core/Params.h>
#include <slamot/core/Start.h>
#include <slamot/models/TargetState.h>

namespace slamot::models
{
/// Constant velocity (Order 1) or constant acceleration (Order 2) but for white noise on the next
/// derivative: state (x, y, vx, vy[, ax, ay]).  Bar-Shalom, Li, Kirubarajan, "Estimation with
/// Applications to Tracking and Navigation", 2001, sections 6.2.2 and 6.2.3; for an acceleration
/// that is constant over a step, 6.3.2.
template <int Order>
class PolynomialTarget
{
  static_assert(Order == 1 || Order == 2);

 public:
  static constexpr int kSize = 2 * (Order + 1);
  struct Params
  {
    double velocityStd;      ///< [m/s] per axis, of a target just seen first
    double accelerationStd;  ///< [m/s²] the same; of no account with Order 1
    double noise;            ///< [m/s² or m/s³ per square root of Hz] per axis
    /// [m/s²] per axis: of an acceleration drawn anew each step of the filter and constant over it,
    /// besides; of no account with Order 2.
    double stepAccelerationStd = 0;
    static Params from(core::Params& p);
  };
  using State = TargetState<kSize>;
  static constexpr int kAngle = -1;  ///< none wraps

  explicit PolynomialTarget(const Params& params) : params_(params) {}

  [[nodiscard]] State start(const core::ObjectStart& start) const;
  [[nodiscard]] State birth(const Gaussian<Point2D>& place) const;
  TargetTransition<kSize> move(State& s, double dt) const;
  void predict(State& s, double dt) const { move(s, dt).applyTo(s.P); }
  bool afterCorrection(State&, const Gaussian<Point2D>*) const { return false; }

  [[nodiscard]] static Gaussian<Pose2D> pose(const State& s);
  [[nodiscard]] static Vector2 velocity(const State& s, Matrix2& cov);
  [[nodiscard]] static Kinematics<kSize, kSize> kinematics(const State& s);
  [[nodiscard]] static bool hasVelocity(const State&) { return true; }
  /// Of the same coordinates, whosoever.
  [[nodiscard]] TargetTransition<kSize> kinematicTransition(const Eigen::Matrix<double, kSize, 1>&,
                                                            double dt) const
  {
    return transition(dt);
  }
  [[nodiscard]] double accelerationStd() const { return params_.accelerationStd; }
  static void widen(State& s, const Matrix3& poseCov);

 private:
  [[nodiscard]] TargetTransition<kSize> transition(double dt) const;
  Params params_;
};

using ConstantVelocityTarget = PolynomialTarget<1>;
using ConstantAccelerationTarget = PolynomialTarget<2>;
extern template class PolynomialTarget<1>;
extern template class PolynomialTarget<2>;
}  // namespace slamot::models
