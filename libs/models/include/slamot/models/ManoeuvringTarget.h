#pragma once

#include <slamot/core/Params.h>
#include <slamot/core/Start.h>
#include <slamot/models/TargetState.h>

#include <array>
#include <optional>
#include <vector>

namespace slamot::models
{
/// A target that now drives straight, now turns, now speeds up: a bank of models between which it
/// switches at random (interacting multiple models: Blom, Bar-Shalom 1988; Bar-Shalom, Li,
/// Kirubarajan 2001, section 11.6.6).  All have the state (x, y, vx, vy, ax, ay) in map axes, and
/// what a model knows better than that is in its transition: no acceleration, or one that turns the
/// velocity.  A target that takes to a turn or an acceleration has a rate or an acceleration drawn
/// anew.
///
/// Outwardly a TargetState with the bank's mean and covariance, which filters may correct and move
/// as they do any other; the bank follows.
class ManoeuvringTarget
{
 public:
  static constexpr int kSize = 6;       ///< x, y, vx, vy, ax, ay
  static constexpr int kAngle = -1;     ///< none wraps
  static constexpr int kMostModes = 5;  ///< a bank has room for
  /// A mean [m, m/s, m/s²].
  using Vector = Eigen::Matrix<double, kSize, 1>;
  /// Its covariance, or a transition.
  using Matrix = Eigen::Matrix<double, kSize, kSize>;

  /// What a target may be doing.
  enum class Mode
  {
    kVelocity,     ///< constant velocity
    kLeftTurn,     ///< turns at a known rate
    kRightTurn,    ///< the same to the right
    kTurn,         ///< coordinated turn: turns at a rate that is estimated
    kAcceleration  ///< constant acceleration
  };
  /// What is known of such targets; keys as in config-ini/rbpf-slamot.manoeuvre.ini.
  struct Params
  {
    std::vector<Mode> modes;  ///< at least one, at most kMostModes
    double modeTime;          ///< [s] mean time from one switch to the next
    double velocityStd;       ///< [m/s] per axis, of a target just seen first
    double accelerationStd;   ///< [m/s²] per axis, of a target that begins to speed up
    double turnRate;          ///< [rad/s] of left and right turns
    double turnRateStd;       ///< [rad/s] of the rate of a coordinated turn that begins
    std::optional<double>
        speed;                 ///< [m/s] where the heading at the start is known; absent: unknown
    double speedStd;           ///< [m/s] its deviation
    double velocityNoise;      ///< [m/s per square root of Hz] along the way, in all modes
    double headingWalk;        ///< [rad per square root of a second] in all modes but acceleration
    double accelerationNoise;  ///< [m/s² per square root of Hz] per axis, in the same modes
    double jerkNoise;          ///< [m/s³ per square root of Hz] per axis, of constant acceleration
    double turnRateNoise;      ///< [rad/s per square root of a second] of a coordinated turn
    /// Reads the keys. \throws core::Error (kConfig)
    static Params from(core::Params& p);
  };
  /// One model's belief.
  struct Member
  {
    Vector x = Vector::Zero();  ///< mean
    Matrix P = Matrix::Zero();  ///< covariance
    double weight = 0;          ///< its probability

    /// Takes in another, its weight multiplied: one Gaussian with the moments of both.
    void add(const Member& m, double times);
  };
  /// The bank, and its mean and covariance as one Gaussian.
  struct State : TargetState<kSize>
  {
    int modes = 0;                        ///< models in the bank
    std::array<Member, kMostModes> bank;  ///< the first `modes`
    TargetState<kSize>
        known;  ///< mean and covariance when the bank was last made to agree with them

    /// TargetState::correct() for each model by its own distance from the mean, then models are
    /// weighed by their likelihoods.
    template <int M>
    void correct(const Vector2& nu, const Matrix2& S, const Matrix2& H, const Matrix2& doubt)
    {
      correct(nu, S, H, doubt, P.leftCols<2>() * H.transpose(), true);
    }
    /// The same where more than the target is uncertain: S is of all that is, and `across` the
    /// covariance of the target with the innovation.  What of both is not the target's own is the
    /// same for all models.
    void correct(const Vector2& nu, const Matrix2& S, const Matrix2& H, const Matrix2& doubt,
                 const Eigen::Matrix<double, kSize, 2>& across, bool isOwn = false);
    /// Makes the bank agree with x and P where somebody else has changed them: each model is moved
    /// and stretched as the whole was.
    void conform();
    /// x and P from the bank.
    void combine();
  };

  /// One model serves all targets.
  explicit ManoeuvringTarget(const Params& params) : params_(params) {}

  /// A target whose start is known: each mode as if it had just begun.
  [[nodiscard]] State start(const core::ObjectStart& start) const;
  /// The same of one first seen at a place, in map axes.
  [[nodiscard]] State birth(const Gaussian<Point2D>& place) const;
  /// The transition is that of the whole.  F is the models' mean for place and velocity, which an
  /// acceleration goes with; Q the rest of what they leave.
  TargetTransition<kSize> move(State& s, double dt) const;
  /// The state dt [s] later.
  void predict(State& s, double dt) const;
  /// Nothing is to be done after a correction; see DifferentialDriveTarget. \return false
  bool afterCorrection(State&, const Gaussian<Point2D>*) const { return false; }

  /// Place and course; a heading that its velocity tells little of is as good as unknown.
  [[nodiscard]] static Gaussian<Pose2D> pose(const State& s);
  /// [m/s], in map axes, with its covariance.
  [[nodiscard]] static Vector2 velocity(const State& s, Matrix2& cov);
  /// The state itself.
  [[nodiscard]] static Kinematics<kSize, kSize> kinematics(const State& s);
  /// Whether kinematics() means something.
  [[nodiscard]] static bool hasVelocity(const State&) { return true; }
  /// Of somebody's (x, y, vx, vy, ax, ay), whose modes are not known: turns and accelerations that
  /// may be are noise.
  [[nodiscard]] TargetTransition<kSize> kinematicTransition(const Vector& x, double dt) const;
  /// [m/s²] of an acceleration of which nothing is told.
  [[nodiscard]] double accelerationStd() const { return params_.accelerationStd; }
  /// Adds the uncertainty of a small rigid motion of the target, given by the covariance of its
  /// pose.
  static void widen(State& s, const Matrix3& poseCov);

 private:
  [[nodiscard]] State bankOf(const TargetState<kSize>& s, bool knowsAcceleration) const;
  void mix(State& s, double dt) const;
  /// What a member becomes that has just taken to a mode.
  [[nodiscard]] Member taking(Mode to, const Member& m) const;
  /// One model's prediction.  \return its derivative.
  Matrix moveMember(Mode mode, Member& m, double dt) const;

  Params params_;
};

/// The transition that takes errors of covariance `from` to `to`, given what becomes of place and
/// velocity (the rows): shrunk where they have less doubt than that, for noise takes nothing away.
/// The acceleration is what place and velocity tell of it.
[[nodiscard]] TargetTransition<6> transitionOf(const ManoeuvringTarget::Matrix& from,
                                               const ManoeuvringTarget::Matrix& to,
                                               const Eigen::Matrix<double, 4, 6>& rows);
}  // namespace slamot::models
