#pragma once

#include <cstdint>
#include <vector>

namespace slamot::filters
{
inline constexpr std::int32_t kNew = -1;       ///< started a landmark or target
inline constexpr std::int32_t kRejected = -2;  ///< neither known nor new

/// A sighting that may be of a thing, and what that costs (nuᵀ S⁻¹ nu + ln |S|).
struct Candidate
{
  double cost;
  std::int32_t sighting;
  std::int32_t thing;
  bool inGate;  ///< within the inner gate; others only forbid that the sighting is new
};

/// Pairs cheapest first, at most one sighting a thing.  matches[i] becomes a thing, kNew where no
/// candidate speaks against it, or kRejected.  Ties go to the lower sighting, then thing.
/// `candidates` is left sorted.
void matchGreedily(std::vector<Candidate>& candidates, std::vector<std::int32_t>& matches);
}  // namespace slamot::filters
