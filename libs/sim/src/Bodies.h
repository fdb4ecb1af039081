#pragma once

#include "AcceleratedPoint.h"
#include "Driver.h"
#include "WhiteAccelerationPoint.h"

#include <slamot/core/Start.h>
#include <slamot/math/gaussian.h>

#include <variant>

namespace slamot::sim
{
/// How small differences of a state go on over a step: to F d + w, w of covariance Q; and the w
/// that was drawn.
struct Transition
{
  Eigen::MatrixXd F, Q;
  Eigen::VectorXd w;
};

/// The robots and their targets, as they truly move.
class Bodies
{
 public:
  /// \param linearise whether transitions are asked for.
  Bodies(const Scenario& scenario, std::uint64_t seed, bool linearise = false);

  /// All by one step.  Returns what each robot knows of its own: the command, and the noise that
  /// driving adds to it.
  std::vector<Gaussian<Pose2D>> move();

  [[nodiscard]] double elapsed() const { return step_ * scenario_.dt; }  ///< since the start [s]
  [[nodiscard]] int step() const { return step_; }
  [[nodiscard]] const Pose2D& robot(int index) const { return robots_[std::size_t(index)].pose; }
  [[nodiscard]] std::map<int, Pose2D> presentTargets() const;
  /// All robots but this one, by their index.
  [[nodiscard]] std::map<int, Point2D> matesOf(int robot) const;

  /// None of a target that is driven: its path tells it.
  [[nodiscard]] std::optional<Vector2> targetVelocity(int id) const;

  /// The last step's, about the true motion, given the command.  A state is a pose, or that of a
  /// point.
  [[nodiscard]] Transition robotTransition(int index) const;
  [[nodiscard]] Transition targetTransition(int id) const;
  /// Deviations of a target's state at the start by what is told of it; none if it is driven.
  [[nodiscard]] std::optional<Eigen::VectorXd> pointStartStd(int id,
                                                             const StartKnowledge& told) const;
  /// Whether a start is told in the coordinates of the target's state.
  [[nodiscard]] bool toldAsState(int id) const;
  /// What is told of such a target's start less the truth, before the first move.
  [[nodiscard]] Eigen::VectorXd toldError(const core::ObjectStart& told, int id) const;

  /// What a robot's filter is told, without the time.
  [[nodiscard]] core::Starts starts(int robot) const;

 private:
  using Point = std::variant<AcceleratedPoint, WhiteAccelerationPoint>;
  struct Body
  {
    Pose2D pose;
    Driver driver;
    std::optional<Point> point = {};  // moves by itself instead of being driven
    // The last step: from where, and what it did there.
    Pose2D before = {}, told = {};
    Gaussian<Pose2D> executed = {};
    Transition linear = {};  // a point's
  };
  [[nodiscard]] Body makeBody(const Motion& motion, const Pose2D& pose, std::uint64_t key) const;
  [[nodiscard]] Command robotCommand(std::size_t robot);
  void drive(Body& body, const Command& c, const Motion& m, std::uint64_t key) const;
  void moveTarget(Body& body, const Motion& m, std::uint64_t key) const;
  [[nodiscard]] static Transition transition(const Body& body);

  Scenario scenario_;
  std::uint64_t seed_;
  bool linearise_;
  int step_ = 0;
  std::vector<Body> robots_;
  std::map<int, Body> targets_;
};
}  // namespace slamot::sim
