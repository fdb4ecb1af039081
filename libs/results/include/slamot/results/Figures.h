#pragma once

#include <slamot/eval/Evaluation.h>
#include <slamot/results/Plot.h>

namespace slamot::results
{
/// A run with what is known of it; all three must outlive the view.
struct RunView
{
  const eval::Record& record;          ///< whole
  const eval::Truth& truth;            ///< may be empty
  const eval::Evaluation& evaluation;  ///< of this record against this truth
};

/// What stands for one thing that moves: a true target with all tracks of it, or, where no target's
/// truth is known, one track.
struct TargetGroup
{
  std::string name;                 ///< for legends and tables
  std::optional<int> truthId;       ///< of the true target
  std::vector<std::size_t> tracks;  ///< places in Record::targets, in order of time
  const eval::TargetEvaluation* evaluation = nullptr;  ///< over all its tracks; null: no truth
};

/// All tracks of a run, each in one group; the last may hold those of no true target.  True targets
/// that were never tracked have a group without tracks.  Must not outlive the evaluation.
[[nodiscard]] std::vector<TargetGroup> targetGroups(const eval::Record& record,
                                                    const eval::Evaluation& evaluation);
/// The tracks of a group: "tracks 0, 3, 4".
[[nodiscard]] std::string trackNames(const eval::Record& record, const TargetGroup& group);

/// Seen from above, in the map's frame, truth laid over it by the evaluation's alignment: paths of
/// robot and targets, landmarks with their 95% ellipses, odometry alone.
[[nodiscard]] Figure mapFigure(const RunView& run);

/// The returns of the laser scans, seen from above, drawn from these poses; none without scans, or
/// where there are no such poses.  Narrow, to be put beside others.
[[nodiscard]] std::optional<Figure> scanFigure(const RunView& run, eval::PosesOf poses);

/// Errors of x, y and heading over time, with bounds of three standard deviations; none without
/// truth.
[[nodiscard]] std::optional<Figure> robotErrorFigure(const RunView& run);
/// The same for the tracks of a true target.
[[nodiscard]] std::optional<Figure> targetErrorFigure(const RunView& run, const TargetGroup& group,
                                                      Ink ink);

/// Effective sample size with marks where particles were resampled; none without particles.
[[nodiscard]] std::optional<Figure> essFigure(const eval::Record& record);

/// Normalised squared errors of robot and targets, with the band that holds 95% of those of a
/// consistent filter; none without truth.
[[nodiscard]] std::optional<Figure> neesFigure(const RunView& run);

/// How a track is called in legends and tables.
[[nodiscard]] std::string nameOf(const eval::TargetTrack& track);
}  // namespace slamot::results
