#pragma once

#include <slamot/core/Params.h>
#include <slamot/core/Start.h>
#include <slamot/models/TargetState.h>

namespace slamot::models
{
/// A velocity that forgets: state (x, y, vx, vy), the velocity an Ornstein-Uhlenbeck process with a
/// given deviation and correlation time, so that a target unseen for long stays near its last place
/// instead of running away.
class DampedVelocityTarget
{
 public:
  /// What is known of such a target before it is seen.
  struct Params
  {
    double velocityStd;   ///< [m/s] per axis, in the long run
    double velocityTime;  ///< [s] after which a velocity is mostly forgotten
    /// Keys target_velocity_std_mps, target_velocity_time_s. \throws core::Error (kConfig)
    static Params from(core::Params& p);
  };
  /// x, y [m], vx, vy [m/s], in map axes.
  using State = TargetState<4>;
  static constexpr int kAngle = -1;  ///< none wraps

  /// One model serves all targets.
  explicit DampedVelocityTarget(const Params& params) : params_(params) {}

  /// A target whose start is known; a velocity that is not has the deviation of the long run.
  [[nodiscard]] State start(const core::ObjectStart& start) const;
  /// A target first seen at a place, in map axes; its velocity has the deviation of the long run.
  [[nodiscard]] State birth(const Gaussian<Point2D>& place) const;
  /// Moves the mean on by dt [s]; the covariance is the caller's to move.
  TargetTransition<4> move(State& s, double dt) const;
  /// The state dt [s] later.
  void predict(State& s, double dt) const { move(s, dt).applyTo(s.P); }
  /// Nothing is to be done after a correction; see DifferentialDriveTarget. \return false
  bool afterCorrection(State&, const Gaussian<Point2D>*) const { return false; }

  /// Place and course; a heading that its velocity tells little of is as good as unknown.
  [[nodiscard]] static Gaussian<Pose2D> pose(const State& s);
  /// [m/s], in map axes, with its covariance.
  [[nodiscard]] static Vector2 velocity(const State& s, Matrix2& cov);
  /// Place and velocity, with the derivative by the state.
  [[nodiscard]] static Kinematics<4, 4> kinematics(const State& s);
  /// Whether kinematics() means something.
  [[nodiscard]] static bool hasVelocity(const State&) { return true; }
  /// Of (x, y, vx, vy), whosoever.
  [[nodiscard]] TargetTransition<4> kinematicTransition(const Eigen::Matrix<double, 4, 1>& x,
                                                        double dt) const;
  /// Adds the uncertainty of a small rigid motion of the target, given by the covariance of its
  /// pose.
  static void widen(State& s, const Matrix3& poseCov);

 private:
  Params params_;
};
}  // namespace slamot::models
