#include "BestMap.h"

#include "Rigid.h"

#include <algorithm>

namespace slamot::filters::rbpf
{
void BestMap::visit(const std::function<void(const core::LandmarkEstimate&)>& visitor) const
{
  std::vector<core::LandmarkEstimate> confirmed;
  map.visit(
      [&](std::uint32_t slot, const maps::Landmark& m)
      {
        if (m.sightings < settings_.confirmSightings || m.existence < 0) return;
        confirmed.push_back(
            {scan_.idOf(slot), moved(shift, Gaussian<Point2D>{m.point(), m.cov()}), m.sightings});
      });
  std::sort(confirmed.begin(), confirmed.end(),
            [](const auto& a, const auto& b) { return a.id < b.id; });
  for (auto& m : confirmed)
  {
    frame.addTo(m.position);
    visitor(m);
  }
}

std::size_t BestMap::size() const
{
  std::size_t n = 0;
  map.visit([&](std::uint32_t, const maps::Landmark& m)
            { n += m.sightings >= settings_.confirmSightings && m.existence >= 0; });
  return n;
}
}  // namespace slamot::filters::rbpf
