#include "Matching.h"

#include <algorithm>
#include <tuple>

namespace slamot::filters
{
void matchGreedily(std::vector<Candidate>& candidates, std::vector<std::int32_t>& matches)
{
  std::fill(matches.begin(), matches.end(), kNew);
  std::sort(candidates.begin(), candidates.end(),
            [](const Candidate& a, const Candidate& b) {
              return std::tie(a.cost, a.sighting, a.thing) < std::tie(b.cost, b.sighting, b.thing);
            });
  for (std::size_t i = 0; i < candidates.size(); ++i)
  {
    const Candidate& c = candidates[i];
    std::int32_t& match = matches[static_cast<std::size_t>(c.sighting)];
    if (match >= 0) continue;
    match = kRejected;
    if (!c.inGate) continue;
    const bool taken =
        std::any_of(candidates.begin(), candidates.begin() + static_cast<std::ptrdiff_t>(i),
                    [&](const Candidate& earlier)
                    {
                      return earlier.thing == c.thing && earlier.inGate &&
                             matches[static_cast<std::size_t>(earlier.sighting)] == c.thing;
                    });
    if (!taken) match = c.thing;
  }
}
}  // namespace slamot::filters
