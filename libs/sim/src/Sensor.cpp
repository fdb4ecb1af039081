#include "Sensor.h"

#include <slamot/models/RangeBearing.h>

#include <algorithm>

namespace slamot::sim
{
namespace
{
/// A sighting of what is at a place.
Vector2 observe(const SensorSetup& sensor, const Pose2D& robot, const Point2D& at,
                const Vector2& truth, math::RandomStream& random)
{
  const double a = random.normal(), b = random.normal();
  // Drawn last, so that the errors of a sensor that glints are those of one that does not, some of
  // them larger.
  const double glint = sensor.glint ? std::sqrt(sensor.glint->drawFactor(random)) : 1;
  if (sensor.positionStd > 0)
  {
    const double std = glint * sensor.positionStd;
    return models::RangeBearing::predict(robot, {at.x + std * a, at.y + std * b});
  }
  return {truth[0] + glint * sensor.rangeStd * a,
          math::wrapToPi(truth[1] + glint * sensor.bearingStd * b)};
}
}  // namespace

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
    const Vector2 seen = observe(sensor, robot, at, z, random);
    out.push_back({seen[0], seen[1], id});
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
  // Of a place: as wide across the ray as along it; at no range any bearing is as likely.
  const double std = sensor.positionStd, nearest = std / math::kPi;
  core::Blob blob;
  blob.label = label;
  if (!sensor.bearingOnly) blob.range = seen.range;
  if (!sensor.bearingOnly) blob.rangeStd = std > 0 ? std : sensor.rangeStd;
  blob.bearing = seen.bearing;
  blob.bearingStd = std > 0 ? std / std::max(seen.range, nearest) : sensor.bearingStd;
  if (sensor.identities) blob.id = seen.object;
  return blob;
}
}  // namespace slamot::sim
