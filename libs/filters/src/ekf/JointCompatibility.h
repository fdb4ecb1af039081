#pragma once

#include "Belief.h"

namespace slamot::filters::ekf
{
/// A sighting that may be of a thing on its own: its rows, and nuᵀ S⁻¹ nu.
struct PossiblePair
{
  int sighting = 0, thing = 0;
  SightingRows rows;
  double d2 = 0;
};

/// The largest set of pairs, one sighting a thing, that together are within the chi-square gate of
/// this probability; among the largest, the one with the smallest joint distance.  Branch and bound
/// over sightings: Neira and Tardos, "Data Association in Stochastic Mapping Using the Joint
/// Compatibility Test", 2001.  Own code: MRPT's data_association_full_covariance would bring 1.3 s
/// of start-up with its library.  After `most` steps, some milliseconds, the best set so far is
/// taken; where a sighting's pairs come nearest first, that is one of near pairs.
/// \param pairs in rising order of sightings.
/// \return places in `pairs`, rising.
[[nodiscard]] std::vector<int> jointlyCompatible(const Belief& belief,
                                                 const std::vector<PossiblePair>& pairs,
                                                 double probability, int most = 5000);
}  // namespace slamot::filters::ekf
