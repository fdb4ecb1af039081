#pragma once

#include <slamot/eval/Evaluation.h>
#include <slamot/eval/Record.h>

#include <optional>
#include <string>
#include <vector>

namespace slamot::study
{
/// A number that a run is judged by.  Those of targets are the mean over the true targets.
struct Metric
{
  const char* name;   ///< with its unit, as in columns of files
  const char* label;  ///< for tables and plots
  int decimals;       ///< that a table shows
  /// Of a ratio of two other metrics, their names: over several runs it is the root of the ratio of
  /// their mean squares.  A bound is one of mean squares; a mean of RMSEs is smaller, by what they
  /// scatter.
  const char* numerator = nullptr;
  const char* denominator = nullptr;  ///< null: the metric is no ratio
};

/// All metrics, in the order of files.
[[nodiscard]] const std::vector<Metric>& metrics();

/// The place of a metric by its name; none if there is no such metric.
[[nodiscard]] std::optional<std::size_t> metricByName(const std::string& name);

/// What one robot of a team exchanged.
struct MessageFigures
{
  double sent = 0;              ///< messages that it told
  double bytes = 0;             ///< of these messages in all
  double fused = 0;             ///< messages of others that changed its estimate
  double candidates = 0;        ///< of them with a sighting of this robot
  std::optional<double> wrong;  ///< of these sightings, those that were not of this robot
};

/// The least root mean square errors that there can be in a run's world, and those that the
/// efficient filter makes with its noises: see sim::PosteriorBound.  Of robots and targets the mean
/// over them, as their errors'.
struct BoundFigures
{
  /// A bound, and what the efficient filter made of this run's noises.
  struct Figure
  {
    double bound = 0;      ///< root mean square over the run
    double efficient = 0;  ///< root mean square error with the noises that were drawn
  };
  std::optional<Figure> robotPosition;  ///< [m]
  std::optional<Figure> robotHeading;   ///< [rad]
  std::optional<Figure> map;            ///< [m], of landmarks at the end
  std::optional<Figure> target;         ///< [m], of positions
};

/// The metrics of a run, in the order of metrics(); absent is what has no truth or does not apply.
/// \param messages of a robot in a team, else null
/// \param bound of its world, null where there is none
[[nodiscard]] std::vector<std::optional<double>> measure(const eval::Record& record,
                                                         const eval::Evaluation& evaluation,
                                                         const MessageFigures* messages = nullptr,
                                                         const BoundFigures* bound = nullptr);

/// Each metric's mean over the robots of a team that have it.
[[nodiscard]] std::vector<std::optional<double>> meanOf(
    const std::vector<std::vector<std::optional<double>>>& robots);
}  // namespace slamot::study
