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
  struct Params
  {
    double velocityStd;   ///< [m/s] per axis, in the long run
    double velocityTime;  ///< [s] after which a velocity is mostly forgotten
    static Params from(core::Params& p);
  };
  using State = TargetState<4>;
  static constexpr int kAngle = -1;  ///< none wraps

  explicit DampedVelocityTarget(const Params& params) : params_(params) {}

  [[nodiscard]] State start(const core::ObjectStart& start) const;
  [[nodiscard]] State birth(const Gaussian<Point2D>& place) const;
  TargetTransition<4> move(State& s, double dt) const;
  void predict(State& s, double dt) const { move(s, dt).applyTo(s.P); }
  bool afterCorrection(State&, const Gaussian<Point2D>*) const { return false; }

  [[nodiscard]] static Gaussian<Pose2D> pose(const State& s);
  [[nodiscard]] static Vector2 velocity(const State& s, Matrix2& cov);
  [[nodiscard]] static Kinematics<4, 4> kinematics(const State& s);
  [[nodiscard]] static bool hasVelocity(const State&) { return true; }
  /// Of (x, y, vx, vy), whosoever.
  [[nodiscard]] TargetTransition<4> kinematicTransition(const Eigen::Matrix<double, 4, 1>& x,
                                                        double dt) const;
  static void widen(State& s, const Matrix3& poseCov);

 private:
  Params params_;
};
}  // namespace slamot::models
