#include <mrpt/core/initializer.h>
#include <mrpt/rtti/CObject.h>
#include <slamot/mrpt/CLandmarkGaussianMap.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

// Both run when a program links this library or loads it as a plugin.
MAP_DEFINITION_REGISTER("slamot::maps::CLandmarkGaussianMap,landmarkGaussianMap",
                        slamot::maps::CLandmarkGaussianMap)
MRPT_INITIALIZER(registerSlamotMaps)
{
  ::mrpt::rtti::registerClass(CLASS_ID(slamot::maps::CLandmarkGaussianMap));
}
IMPLEMENTS_SERIALIZABLE(CLandmarkGaussianMap, CMetricMap, slamot::maps)

namespace slamot::maps
{
namespace
{
using Landmark = CLandmarkGaussianMap::Landmark;

bool hasLowerId(const Landmark& a, std::int32_t id)
{
  return a.id < id;
}

void check(const Landmark& m)
{
  const std::string who = "landmark " + std::to_string(m.id);
  if (m.id < 0 || m.sightings < 0) throw std::domain_error(who + ": negative id or count");
  const Point2D& p = m.position.mean;
  const Matrix2& P = m.position.cov;
  if (!std::isfinite(p.x) || !std::isfinite(p.y) || !P.allFinite())
    throw std::domain_error(who + ": a position or covariance that is not finite");
  // The correlation may leave [-1, 1] by rounding.
  const double most = std::sqrt(std::max(P(0, 0), 0.0)) * std::sqrt(std::max(P(1, 1), 0.0));
  if (P(0, 0) < 0 || P(1, 1) < 0 || std::abs(P(0, 1)) > most * (1 + 1e-9))
    throw std::domain_error(who + ": a covariance with a negative eigenvalue");
  if (!(m.existence >= 0 && m.existence <= 1))
    throw std::domain_error(who + ": an existence outside [0, 1]");
}
}  // namespace

CLandmarkGaussianMap CLandmarkGaussianMap::fromView(const core::LandmarkView& view)
{
  CLandmarkGaussianMap map;
  map.landmarks_.reserve(view.size());
  view.visit([&](const core::LandmarkEstimate& l) { map.set({l.id, l.position, l.sightings, 1}); });
  return map;
}

const Landmark* CLandmarkGaussianMap::find(std::int32_t id) const
{
  const auto at = std::lower_bound(landmarks_.begin(), landmarks_.end(), id, hasLowerId);
  return at != landmarks_.end() && at->id == id ? &*at : nullptr;
}

void CLandmarkGaussianMap::set(const Landmark& landmark)
{
  check(landmark);
  auto at = std::lower_bound(landmarks_.begin(), landmarks_.end(), landmark.id, hasLowerId);
  if (at != landmarks_.end() && at->id == landmark.id)
    *at = landmark;
  else
    at = landmarks_.insert(at, landmark);
  at->position.cov(1, 0) = at->position.cov(0, 1);
}

std::string CLandmarkGaussianMap::asString() const
{
  return "Landmark map: " + std::to_string(landmarks_.size()) + " landmarks";
}

CLandmarkGaussianMap::TMapDefinition::TMapDefinition() = default;

void CLandmarkGaussianMap::TMapDefinition::loadFromConfigFile_map_specific(
    const ::mrpt::config::CConfigFileBase& source, const std::string& sectionNamePrefix)
{
  insertionOpts.loadFromConfigFile(source, sectionNamePrefix + "_insertOpts");
}

void CLandmarkGaussianMap::TMapDefinition::dumpToTextStream_map_specific(std::ostream& out) const
{
  insertionOpts.dumpToTextStream(out);
}

SLAMOT_METRIC_MAP_POINTER CLandmarkGaussianMap::internal_CreateFromMapDefinition(
    const ::mrpt::maps::TMetricMapInitializer& def)
{
  auto* map = new CLandmarkGaussianMap;
  SLAMOT_METRIC_MAP_POINTER out(map);
  map->insertionOptions = dynamic_cast<const TMapDefinition&>(def).insertionOpts;
  return out;
}
}  // namespace slamot::maps
