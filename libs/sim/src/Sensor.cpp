#include "Sensor.h"

#include <slamot/models/RangeBearing.h>

#include <algorithm>

namespace slamot::sim
{
std::vector<Seen> sense(const SensorSetup& sensor, const Pose2D& robot,
                        const std::map<int, Point2D>& objects, const ScanKeys& keys)
{
  std::vector<Seen> out;
  for (const auto& [id, at] : objects)
  {
    const auto z = models::RangeBearing::predict(robot, at);
    if (!sensor.fov.contains(z[0], z[1])) continue;
    auto random =
        stream(keys.seed, keys.sensing, keys.step, keys.observer + static_cast<std::uint64_t>(id));
    if (random.uniform() >= sensor.detection) continue;
    const double range = z[0] + sensor.rangeStd * random.normal();
    out.push_back({range, math::wrapToPi(z[1] + sensor.bearingStd * random.normal()), id});
  }
  auto random = stream(keys.seed, keys.clutter, keys.step, keys.observer);
  for (int n = random.poisson(sensor.clutter); n > 0; --n)
  {
    const double range = random.uniform(sensor.fov.rangeMin, sensor.fov.rangeMax);
    out.push_back({range, random.uniform(sensor.fov.bearingMin, sensor.fov.bearingMax)});
  }
  std::sort(out.begin(), out.end(),
            [](const Seen& a, const Seen& b) { return a.bearing < b.bearing; });
  return out;
}

bool usable(const SensorSetup& sensor, const core::FieldOfView& fov, const Seen& seen)
{
  // A bearing-only blob has no range to be wrong.
  if (sensor.bearingOnly) return seen.bearing >= fov.bearingMin && seen.bearing <= fov.bearingMax;
  return seen.range > 0 && fov.contains(seen.range, seen.bearing);
}

core::FieldOfView blobView(const Scenario& scenario)
{
  const core::FieldOfView& a = scenario.targetSensor->fov;
  const core::FieldOfView& b = scenario.mateSensor ? scenario.mateSensor->fov : a;
  return {std::min(a.rangeMin, b.rangeMin), std::max(a.rangeMax, b.rangeMax),
          std::min(a.bearingMin, b.bearingMin), std::max(a.bearingMax, b.bearingMax)};
}

core::Sighting toSighting(const SensorSetup& sensor, const Seen& seen)
{
  return {seen.range, seen.bearing, sensor.rangeStd, sensor.bearingStd,
          sensor.identities ? seen.object : core::kNoId};
}

core::Blob toBlob(const SensorSetup& sensor, const Seen& seen, const std::string& label)
{
  core::Blob blob;
  blob.label = label;
  if (!sensor.bearingOnly) blob.range = seen.range;
  if (!sensor.bearingOnly) blob.rangeStd = sensor.rangeStd;
  blob.bearing = seen.bearing;
  blob.bearingStd = sensor.bearingStd;
  if (sensor.identities) blob.id = seen.object;
  return blob;
}
}  // namespace slamot::sim
