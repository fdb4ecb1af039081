#pragma once

#include <slamot/core/Params.h>
#include <slamot/core/Start.h>

#include <Eigen/LU>
#include <variant>

namespace slamot::models
{
/// A target's state vector with its covariance; the first two coordinates are its place (x, y) [m].
template <int N>
struct TargetState
{
  Eigen::Matrix<double, N, 1> x = Eigen::Matrix<double, N, 1>::Zero();
  Eigen::Matrix<double, N, N> P = Eigen::Matrix<double, N, N>::Zero();

  [[nodiscard]] Point2D point() const { return {x[0], x[1]}; }
  [[nodiscard]] Matrix2 pointCov() const { return P.template topLeftCorner<2, 2>(); }

  /// Kalman update by an innovation nu with covariance S, H its derivative by the place (Mx2).
  template <int M>
  void correct(const Eigen::Matrix<double, M, 1>& nu, const Eigen::Matrix<double, M, M>& S,
               const Eigen::Matrix<double, M, 2>& H)
  {
    const Eigen::Matrix<double, N, M> PHt = P.template leftCols<2>() * H.transpose();
    const Eigen::Matrix<double, N, M> K = PHt * S.inverse();
    x += K * nu;
    P -= K * PHt.transpose();
    P = (0.5 * (P + P.transpose())).eval();
  }
};

/// Differential drive: state (x, y, phi, v, omega); a step turns first, then moves.  v and omega
/// are constant but for a white noise drawn anew each step and a slow walk.  With known v and omega
/// this is the target model of Wu and Sun 2013, eq. (13)-(17) as corrected. A target that starts
/// without a heading waits, its place alone followed, until it has moved far enough from its first
/// sighting to show one.
class DifferentialDriveTarget
{
 public:
  struct Params
  {
    double speed;          ///< [m/s] at the start
    double speedStd;       ///< [m/s] of the start's speed; 0: known
    double turnRate;       ///< [rad/s] at the start
    double turnRateStd;    ///< [rad/s]; 0: known
    double speedNoise;     ///< [m/s] drawn anew each step
    double turnRateNoise;  ///< [rad/s] drawn anew each step
    double speedWalk;      ///< [m/s per square root of a second]
    double turnRateWalk;   ///< [rad/s per square root of a second]
    static Params from(core::Params& p);
  };
  struct State : TargetState<5>
  {
    bool headed = true;  // whether phi means something
    Point2D anchor;      // where a target without heading was first seen
    Matrix2 anchorCov = Matrix2::Zero();
    double sinceAnchor = 0;  // [s]
  };

  explicit DifferentialDriveTarget(const Params& params) : params_(params) {}

  [[nodiscard]] State start(const core::ObjectStart& start) const;
  [[nodiscard]] State birth(const Gaussian<Point2D>& place) const;
  /// The state dt [s] later.
  void predict(State& s, double dt) const;
  /// To be called after a correction, with the place that the sighting alone gives.
  void afterCorrection(State& s, const Gaussian<Point2D>* seenAt) const;

  [[nodiscard]] static Gaussian<Pose2D> pose(const State& s);
  [[nodiscard]] static Vector2 velocity(const State& s, Matrix2& cov);
  /// Adds the uncertainty of a small rigid motion of the target, given by the covariance of its
  /// pose.
  static void widen(State& s, const Matrix3& poseCov);

 private:
  Params params_;
};

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

  explicit DampedVelocityTarget(const Params& params) : params_(params) {}

  [[nodiscard]] State start(const core::ObjectStart& start) const;
  [[nodiscard]] State birth(const Gaussian<Point2D>& place) const;
  void predict(State& s, double dt) const;
  void afterCorrection(State&, const Gaussian<Point2D>*) const {}

  [[nodiscard]] static Gaussian<Pose2D> pose(const State& s);
  [[nodiscard]] static Vector2 velocity(const State& s, Matrix2& cov);
  static void widen(State& s, const Matrix3& poseCov);

 private:
  Params params_;
};

/// The motion model that the key `target_motion` names.
using TargetMotion = std::variant<DifferentialDriveTarget, DampedVelocityTarget>;
[[nodiscard]] TargetMotion targetMotionFrom(core::Params& p);
}  // namespace slamot::models
