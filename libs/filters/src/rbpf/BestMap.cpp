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
        if (!isShown(m)) return;
        confirmed.push_back({scan_.idOf(slot), moved(shift, Gaussian<Point2D>{m.point(), m.cov()}),
                             static_cast<int>(m.sightings)});
      });
  std::sort(confirmed.begin(), confirmed.end(),
            [](const auto& a, const auto& b) { return a.id < b.id; });
  for (auto& m : confirmed)
  {
    frame.addTo(m.position);
    visitor(m);
  }
}

bool BestMap::isShown(const maps::Landmark& m) const
{
  if (settings_.intensity) return m.confirmed;
  return static_cast<int>(m.sightings) >= settings_.confirmSightings && m.existence >= 0;
}

std::size_t BestMap::size() const
{
  std::size_t n = 0;
  map.visit([&](std::uint32_t, const maps::Landmark& m) { n += isShown(m); });
  return n;
}
}  // namespace slamot::filters::rbpf
