#pragma once

#include "PoseUpdate.h"
#include "Settings.h"

#include <vector>

namespace slamot::filters::rbpf
{
/// A sighting that may be of a landmark.
struct PossiblePair
{
  std::int32_t sighting, thing;
  Innovation innovation;  ///< from the prior pose, whose covariance is not in it
  double d2;              ///< nuᵀ S⁻¹ nu with the pose's covariance in S
};

/// Association of a whole scan by what its pairs are together, given that they share a pose: the
/// landmarks are independent of each other, so that the only coupling is the pose's, and taking in
/// a pair conditions the pose for the next (three coordinates, whatever the number of pairs).
///
/// - sequential compatibility: sighting by sighting the nearest landmark, given the pairs before
/// it,
///   if all pairs so far pass their joint gate;
/// - joint compatibility (Neira and Tardos 2001): of the largest sets of pairs that pass their
/// joint
///   gate, the one with the smallest joint distance;
/// - joint maximum likelihood: the pairs of largest joint likelihood, a sighting without a pair
///   counting as p_new.
/// The last two are exact by branch and bound until `kMostTries` pairs were looked at, and the best
/// found then; the first set tried takes the likeliest pair of one sighting after the other.
class JointMatching
{
 public:
  static constexpr int kMostTries = 20000;

  explicit JointMatching(const Settings& settings) : settings_(settings) {}

  /// Room for scans of this many sightings.  Not for use while others match.
  void reserve(std::size_t sightings);

  struct Scratch
  {
    struct Level
    {
      PoseUpdate update;
      PoseUpdate::Result pose;
    };
    struct Option
    {
      double cost, d2;
      std::int32_t pair;
    };
    std::vector<PossiblePair> pairs;
    std::vector<Option> options;  // of all levels so far
    std::vector<Level> levels;
    std::vector<std::size_t> begins, order;  // of each sighting's pairs; sightings by levels
    std::vector<double> mostLeft;            // what the levels from here on may add at most
    std::vector<std::int32_t> chosen, best;  // pairs by levels
  };

  /// \param root a square root of the pose's covariance; zero for a sampled pose.
  /// \param logNew log p_new for each sighting.
  /// \param scratch its pairs are the possible ones, grouped by sightings.
  /// \return in `matches` for each sighting a thing; kRejected where it has pairs but none was
  /// chosen, kNew where it has none.  By likelihood, a sighting with pairs may be kNew too.
  void match(const Matrix3& root, const std::vector<double>& logNew, Scratch& scratch,
             std::vector<std::int32_t>& matches) const;

 private:
  class Search;
  const Settings& settings_;
  std::vector<double> gates_;  // chi-square bounds by number of pairs
};
}  // namespace slamot::filters::rbpf
