#pragma once

#include <slamot/eval/Evaluation.h>

#include <functional>
#include <map>

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
[[nodiscard]] std::optional<TargetSetErrors> evaluateTargetSet(const Record&, const Truth&,
                                                               const EvaluationOptions&,
                                                               const Pose2D& truthFromMap);
[[nodiscard]] LandmarkEvaluation evaluateLandmarks(const Record&, const Truth&,
                                                   const EvaluationOptions&,
                                                   const Pose2D& truthFromMap);
/// The rigid alignment under which a map is nearest to the true one: the one with the least GOSPA
/// found, from several starts by turns of pairing and least squares.  A path's own alignment would
/// not do: it was recorded while the map still drifted.
/// \param starts alignments to try; at least one.
[[nodiscard]] Pose2D alignMap(const Record&, const Truth&, double gospaCutoff,
                              const std::vector<Pose2D>& starts);
/// The true landmark that most sightings of each mapped one were of, the earliest if several;
/// core::kNoId for clutter.  Landmarks of which the truth tells nothing are left out.
[[nodiscard]] std::map<int, int> foundersByLandmark(const Record&, const Truth&);
[[nodiscard]] std::optional<AssociationCounts> countAssociations(const Record&, const Truth&);
/// What is of the robot itself, whatever point of it the errors are taken at: relations and scans.
void evaluateItself(const Record&, const Truth&, Evaluation&);
}  // namespace slamot::eval
