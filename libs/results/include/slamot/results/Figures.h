#pragma once

#include <slamot/eval/Evaluation.h>
#include <slamot/results/Plot.h>

namespace slamot::results
{
/// A run with what is known of it; all three must outlive the view.
struct RunView
{
  const eval::Record& record;
  const eval::Truth& truth;            ///< may be empty
  const eval::Evaluation& evaluation;  ///< of this record against this truth
};

/// Seen from above, in the map's frame, truth laid over it by the evaluation's alignment: paths of
/// robot and targets, landmarks with their 95% ellipses, odometry alone.
[[nodiscard]] Figure mapFigure(const RunView& run);

/// Errors of x, y and heading over time, with bounds of three standard deviations; none without
/// truth.
[[nodiscard]] std::optional<Figure> robotErrorFigure(const RunView& run);
/// The same for a target, given by its place in Record::targets.
[[nodiscard]] std::optional<Figure> targetErrorFigure(const RunView& run, std::size_t target);

/// Effective sample size with marks where particles were resampled; none without particles.
[[nodiscard]] std::optional<Figure> essFigure(const eval::Record& record);

/// Normalised squared errors of robot and targets, with the band that holds 95% of those of a
/// consistent filter; none without truth.
[[nodiscard]] std::optional<Figure> neesFigure(const RunView& run);

/// How a target is called in legends and tables.
[[nodiscard]] std::string nameOf(const eval::TargetTrack& track);
}  // namespace slamot::results
