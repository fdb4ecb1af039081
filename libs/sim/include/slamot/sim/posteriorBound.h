#pragma once

#include <slamot/sim/Scenario.h>

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

namespace slamot::sim
{
/// The posterior Cramér-Rao bound of a run: how small the errors of a filter can be at best, which
/// is told all associations.  Root mean squares over the run, as of errors.
struct PosteriorBound
{
  /// A bound, and how an efficient filter would have fared.
  struct Figure
  {
    double bound = 0;  ///< the root of a mean variance
    /// The efficient filter's own error, with the noises that this run truly drew: over seeds its
    /// mean square is that of the bound.  It has the luck of the seed, as all filters' errors have.
    double efficient = 0;
  };
  /// The bounds of a robot's pose.
  struct Robot
  {
    Figure position;  ///< [m], over the steps, the start among them
    Figure heading;   ///< [rad]
  };
  std::vector<Robot> robots;  ///< by index, as many as were asked for
  /// At the end, over the landmarks seen [m]; none if none was.
  std::optional<Figure> map;
  /// Of each target's position, over the steps at which it is there, from the start if it is known,
  /// else from its first sighting [m]; absent without such a step.
  std::map<int, Figure> targets;
};

/// Tichavský, Muravchik, Nehorai, "Posterior Cramér-Rao bounds for discrete-time nonlinear
/// filtering", 1998, eq. 21, in covariance form, with all derivatives at the truth of this run: its
/// poses, its noises, the landmarks and blobs that were truly seen.  It begins with what the
/// scenario tells of the starts.  Commands count as given, also a target's: as if it told nothing
/// of where its driver steered for.  One run's value scatters little with the seed, errors much.
/// \param robots so many of the scenario's first, in one joint state with all that they see; one
/// robot sees its mates, but does not know them.
/// \return none if so many landmarks are seen that it would take gigabytes.
/// \throws core::Error as World.
[[nodiscard]] std::optional<PosteriorBound> posteriorBound(const Scenario& scenario,
                                                           std::uint64_t seed, int robots = 1);
}  // namespace slamot::sim
