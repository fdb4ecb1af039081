#pragma once

#include <slamot/core/Filter.h>

#include <Eigen/Core>

namespace slamot::core
{
/// What a filter tells of itself to a team: its robot's pose and one target, jointly Gaussian, in
/// map axes.  Coordinates: the robot's x, y [m], theta [rad]; then, with a target, its x, y [m],
/// vx, vy [m/s] and, if the filter's model has them, ax, ay [m/s²].
struct RobotAndTarget
{
  static constexpr int kRobot = 3;  ///< coordinates of the robot; the target's begin here

  double time = 0;       ///< of the belief [s], the robot's own clock
  int target = kNoId;    ///< identity of the target; none: `mean` has the robot only
  Eigen::VectorXd mean;  ///< 3, 7 or 9 coordinates
  Eigen::MatrixXd cov;   ///< symmetric, positive semidefinite

  /// How many coordinates are the target's: 0, 4 or 6.
  [[nodiscard]] int targetSize() const { return static_cast<int>(mean.size()) - kRobot; }
};

/// What a robot learnt from another one: b = H x + e, with x the coordinates of its own
/// RobotAndTarget (the same target) and e of covariance `cov`, correlated with the errors of x in
/// an unknown way, but for the part `independent`.
struct Evidence
{
  int target = kNoId;           ///< which target H's columns from RobotAndTarget::kRobot on are of
  Eigen::MatrixXd H;            ///< rows of b, columns of RobotAndTarget
  Eigen::VectorXd innovation;   ///< b - H x
  Eigen::MatrixXd cov;          ///< of e, in all: symmetric, positive definite
  Eigen::MatrixXd independent;  ///< the part of `cov` that is noise of its own; may be zero
};

/// How correlated estimates are made one.
enum class FusionRule
{
  kNone,     ///< nothing is exchanged, each robot is by itself
  kCi,       ///< covariance intersection on the whole state: consistent for every correlation
  kSplitCi,  ///< the same, the independent part of the noise not inflated
  kIci,      ///< inverse covariance intersection, regressed on the rest: not guaranteed
  kPaper     ///< block by block as published: not consistent
};

/// How a filter is to take in an Evidence.
struct FusionOptions
{
  FusionRule rule = FusionRule::kCi;  ///< which of the rules
  std::optional<double> omega;  ///< weight of one's own estimate, in (0, 1]; absent: optimised
  double headingLever = 5;  ///< [m]: the criterion adds (lever times heading)² to the positions'
};

/// What became of an Evidence.
struct Fusion
{
  bool fused = false;  ///< false: it did not pay, and nothing changed
  double omega = 1;    ///< the weight that was used; 1 if nothing was fused
};

/// A filter that can be one of a team: gives and takes a Gaussian over its robot and a target.
class TeamFilter : public Filter
{
 public:
  /// Its robot and the target of this identity; the robot alone where it has no such target (or
  /// none is asked for).
  [[nodiscard]] virtual RobotAndTarget robotAndTarget(int target) const = 0;

  /// Takes in what another robot told.  \throws Error (kNonsense) if a value is not finite, sizes
  /// do not agree or a covariance is not positive definite; the filter is then as before the call.
  virtual Fusion fuse(const Evidence& evidence, const FusionOptions& options) = 0;

  /// Moves the target of somebody's estimate on by dt [s] >= 0, by this filter's model of targets.
  virtual void predictTarget(RobotAndTarget& other, double dt) const = 0;
};
}  // namespace slamot::core
