#pragma once

#include <slamot/eval/Evaluation.h>

namespace slamot::eval
{
/// none, first-pose, rigid.
[[nodiscard]] std::vector<std::string> alignNames();
/// As alignNamed() reads it.
[[nodiscard]] std::string nameOf(Align align);
/// None for a name that is not one of alignNames().
[[nodiscard]] std::optional<Align> alignNamed(const std::string& name);

/// The rotation and translation, without scale, that takes `from` nearest to `to` in the sense of
/// least squares.  Umeyama 1991, eq. 39-42 with c = 1, in closed form for the plane.  A single
/// point, or all at one place, leaves the rotation 0.
/// \throws std::invalid_argument unless both have the same number of points, at least one.
[[nodiscard]] Pose2D rigidAlignment(const std::vector<Point2D>& from,
                                    const std::vector<Point2D>& to);

/// A run and its truth, for alignment().
struct RunWithTruth
{
  const Record* record;  ///< never null
  const Truth* truth;    ///< never null
};

/// The pose that takes the map's frame to the truth's; several robots share one map frame and are
/// aligned together, once.  None where times have nothing in common (first-pose: or no heading).
[[nodiscard]] std::optional<Pose2D> alignment(const std::vector<RunWithTruth>& runs, Align align,
                                              double maxTruthGap);

/// Each robot's evaluation, all with one alignment: that of alignment(), or none where it gives
/// none.
[[nodiscard]] std::vector<Evaluation> evaluateTogether(const std::vector<RunWithTruth>& runs,
                                                       EvaluationOptions options);
}  // namespace slamot::eval
