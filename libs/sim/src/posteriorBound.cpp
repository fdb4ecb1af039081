#include <slamot/sim/posteriorBound.h>

#include "BoundRecursion.h"

namespace slamot::sim
{
namespace
{
constexpr std::size_t kMostSeen = 3000;  // landmarks: 300 MB
}

std::optional<PosteriorBound> posteriorBound(const Scenario& scenario, std::uint64_t seed,
                                             int robots)
{
  BoundRecursion recursion(scenario, seed, robots);
  for (int i = 0; i < scenario.steps; ++i)
  {
    recursion.step();
    if (recursion.landmarksSeen() > kMostSeen) return std::nullopt;
  }
  return recursion.result();
}
}  // namespace slamot::sim
