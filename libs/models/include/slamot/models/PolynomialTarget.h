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
  static constexpr int kSize = 2 * (Order + 1);  ///< coordinates of the state
  /// What is known of such a target before it is seen.
  struct Params
  {
    double velocityStd;      ///< [m/s] per axis, of a target just seen first
    double accelerationStd;  ///< [m/s²] the same; of no account with Order 1
    double noise;            ///< [m/s² or m/s³ per square root of Hz] per axis
    /// [m/s²] per axis: of an acceleration drawn anew each step of the filter and constant over it,
    /// besides; of no account with Order 2.
    double stepAccelerationStd = 0;
    /// Keys target_velocity_std_mps, target_acceleration_std_mps2 and the noise's, by the order.
    /// \throws core::Error (kConfig)
    static Params from(core::Params& p);
  };
  /// x, y [m], vx, vy [m/s] and, with Order 2, ax, ay [m/s²], in map axes.
  using State = TargetState<kSize>;
  static constexpr int kAngle = -1;  ///< none wraps

  /// One model serves all targets.
  explicit PolynomialTarget(const Params& params) : params_(params) {}

  /// A target whose start is known; derivatives that are not have the deviations of one just seen.
  [[nodiscard]] State start(const core::ObjectStart& start) const;
  /// A target first seen at a place, in map axes; its derivatives have the deviations of one just
  /// seen.
  [[nodiscard]] State birth(const Gaussian<Point2D>& place) const;
  /// Moves the mean on by dt [s]; the covariance is the caller's to move.
  TargetTransition<kSize> move(State& s, double dt) const;
  /// The state dt [s] later.
  void predict(State& s, double dt) const { move(s, dt).applyTo(s.P); }
  /// Nothing is to be done after a correction; see DifferentialDriveTarget. \return false
  bool afterCorrection(State&, const Gaussian<Point2D>*) const { return false; }

  /// Place and course; a heading that its velocity tells little of is as good as unknown.
  [[nodiscard]] static Gaussian<Pose2D> pose(const State& s);
  /// [m/s], in map axes, with its covariance.
  [[nodiscard]] static Vector2 velocity(const State& s, Matrix2& cov);
  /// The state itself, and the identity.
  [[nodiscard]] static Kinematics<kSize, kSize> kinematics(const State& s);
  /// Whether kinematics() means something.
  [[nodiscard]] static bool hasVelocity(const State&) { return true; }
  /// Of the same coordinates, whosoever.
  [[nodiscard]] TargetTransition<kSize> kinematicTransition(const Eigen::Matrix<double, kSize, 1>&,
                                                            double dt) const
  {
    return transition(dt);
  }
  /// Of a target just seen first, per axis [m/s²].
  [[nodiscard]] double accelerationStd() const { return params_.accelerationStd; }
  /// Adds the uncertainty of a small rigid motion of the target, given by the covariance of its
  /// pose.
  static void widen(State& s, const Matrix3& poseCov);

 private:
  [[nodiscard]] TargetTransition<kSize> transition(double dt) const;
  Params params_;
};

using ConstantVelocityTarget = PolynomialTarget<1>;      ///< state (x, y, vx, vy)
using ConstantAccelerationTarget = PolynomialTarget<2>;  ///< state (x, y, vx, vy, ax, ay)
extern template class PolynomialTarget<1>;
extern template class PolynomialTarget<2>;
}  // namespace slamot::models
