#pragma once

#include <slamot/eval/Evaluation.h>

#include <functional>

namespace slamot::eval
{
/// Squared error by covariance, eᵀP⁻¹e; none if P is singular to rounding, whatever its units.
[[nodiscard]] std::optional<double> nees(const Eigen::Ref<const Eigen::VectorXd>& e,
                                         const Eigen::Ref<const Eigen::MatrixXd>& P);

/// The error of an estimate in map axes, laid over the truth by `truthFromMap`.
[[nodiscard]] StepError poseError(std::size_t row, const Gaussian<Pose2D>& estimate,
                                  const TimedPose& truth, const Pose2D& truthFromMap);

/// The error of a target as its observer sees it, in the observer's axes; without NEES.
[[nodiscard]] StepError relativeError(std::size_t row, const Pose2D& robot, const Pose2D& target,
                                      const Pose2D& trueRobot, const TimedPose& trueTarget);

/// Sums up the errors that `use` accepts.
[[nodiscard]] ErrorSummary summarise(const std::vector<StepError>& steps,
                                     const std::function<bool(const StepError&)>& use);
[[nodiscard]] ErrorSummary summarise(const std::vector<StepError>& steps);

// The parts of evaluate().
[[nodiscard]] std::vector<TargetEvaluation> evaluateTracks(const Record&, const Truth&,
                                                           const EvaluationOptions&,
                                                           const Pose2D& truthFromMap);
[[nodiscard]] std::vector<TargetEvaluation> evaluateTrueTargets(
    const Record&, const Truth&, const EvaluationOptions&, const Pose2D& truthFromMap,
    const std::vector<TargetEvaluation>& tracks);
[[nodiscard]] LandmarkEvaluation evaluateLandmarks(const Record&, const Truth&,
                                                   const EvaluationOptions&,
                                                   const Pose2D& truthFromMap);
[[nodiscard]] std::optional<AssociationCounts> countAssociations(const Record&, const Truth&);
}  // namespace slamot::eval
