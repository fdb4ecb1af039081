#pragma once

#include <slamot/core/Params.h>
#include <slamot/core/Start.h>
#include <slamot/models/TargetState.h>

namespace slamot::models
{
/// Differential drive: state (x, y, phi, v, omega); a step turns first, then moves.  v and omega
/// are constant but for a white noise drawn anew each step and a slow walk.  With known v and omega
/// this is the target model of Wu and Sun 2013, eq. (13)-(17) as corrected. A target that starts
/// without a heading waits, its place alone followed, until it has moved far enough from its first
/// sighting to show one.
class DifferentialDriveTarget
{
 public:
  /// What is known of such a target before it is seen.
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
    /// Keys target_speed_mps, target_turn_rate_deg_per_s, their _std_, _noise_ and _walk_, as
    /// config-ini/rbpf-slamot.experiment1.ini has them. \throws core::Error (kConfig)
    static Params from(core::Params& p);
  };
  /// x, y [m], phi [rad], v [m/s], omega [rad/s], in map axes; and what is known until phi is.
  struct State : TargetState<5>
  {
    bool headed = true;                   ///< whether phi means something
    Point2D anchor;                       ///< where a target without heading was first seen [m]
    Matrix2 anchorCov = Matrix2::Zero();  ///< of `anchor` [m²]
    double sinceAnchor = 0;               ///< since then [s]
  };
  static constexpr int kAngle = 2;  ///< the coordinate that wraps

  /// One model serves all targets.
  explicit DifferentialDriveTarget(const Params& params) : params_(params) {}

  /// A target whose start is known; without heading and velocity it waits for its heading.
  [[nodiscard]] State start(const core::ObjectStart& start) const;
  /// A target first seen at a place, in map axes; it waits for its heading.
  [[nodiscard]] State birth(const Gaussian<Point2D>& place) const;
  /// Moves the mean on by dt [s]; the covariance is the caller's to move.
  TargetTransition<5> move(State& s, double dt) const;
  /// The state dt [s] later.
  void predict(State& s, double dt) const { move(s, dt).applyTo(s.P); }
  /// To be called after a correction, with the place that the sighting alone gives.
  /// \return whether it gave the target its heading, and so replaced its covariance.
  bool afterCorrection(State& s, const Gaussian<Point2D>* seenAt) const;

  /// Place and heading; the variance of an unknown heading is that of a uniform one at the most.
  [[nodiscard]] static Gaussian<Pose2D> pose(const State& s);
  /// [m/s], in map axes, with its covariance.
  [[nodiscard]] static Vector2 velocity(const State& s, Matrix2& cov);
  /// Place and velocity, with the derivative by the state.
  [[nodiscard]] static Kinematics<4, 5> kinematics(const State& s);
  /// Whether kinematics() means something: not while the target waits for its heading.
  [[nodiscard]] static bool hasVelocity(const State& s) { return s.headed; }
  /// For somebody's (x, y, vx, vy), of which turns are not known: they count as noise.
  [[nodiscard]] TargetTransition<4> kinematicTransition(const Eigen::Matrix<double, 4, 1>& x,
                                                        double dt) const;
  /// Adds the uncertainty of a small rigid motion of the target, given by the covariance of its
  /// pose.
  static void widen(State& s, const Matrix3& poseCov);

 private:
  Params params_;
};
}  // namespace slamot::models
