#include <slamot/sim/World.h>

#include "Bodies.h"
#include "Sensor.h"
#include "starts.h"

#include <cmath>

namespace slamot::sim
{
namespace
{
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
}  // namespace

struct World::Impl
{
  Impl(const Scenario& s, std::uint64_t seedGiven, bool rawSightings);

  // Whole ticks of 100 ns, as a rawlog holds them.
  [[nodiscard]] double time() const
  {
    return std::round((scenario.startTime + bodies.elapsed()) * 1e7) / 1e7;
  }
  [[nodiscard]] std::vector<Seen> scan(const SensorSetup& sensor,
                                       const std::map<int, Point2D>& objects, Purpose sensing,
                                       Purpose clutter) const
  {
    return sense(sensor, bodies.robot(), objects,
                 {seed, sensing, clutter, static_cast<std::uint64_t>(bodies.step())});
  }
  void scanLandmarks(core::Step& out);
  void scanTargets(core::Step& out);
  void recordPoses();

  Scenario scenario;
  std::uint64_t seed;
  bool raw;
  Bodies bodies;
  core::Starts starts;
  eval::Truth truth;
};

World::Impl::Impl(const Scenario& s, std::uint64_t seedGiven, bool rawSightings)
    : scenario(s), seed(seedGiven), raw(rawSightings), bodies(s, seedGiven), starts(bodies.starts())
{
  starts.time = time();
  truth.landmarks = placeLandmarks(s, seed);
  recordPoses();
}

void World::Impl::recordPoses()
{
  truth.robot.poses.push_back({time(), bodies.robot(), true});
  for (const auto& [id, pose] : bodies.presentTargets())
    truth.targets[id].poses.push_back({time(), pose, true});
}

void World::Impl::scanLandmarks(core::Step& out)
{
  const SensorSetup& sensor = scenario.landmarkSensor;
  out.landmarks.emplace().fov = sensor.fov;
  int index = 0;
  for (const Seen& seen :
       scan(sensor, truth.landmarks, Purpose::kLandmarkSensing, Purpose::kLandmarkClutter))
  {
    const bool kept = usable(sensor, seen);
    if (kept) truth.associations.push_back({out.time, index++, seen.object});
    if (kept || raw)
      out.landmarks->sightings.push_back(toSighting(sensor, seen));
    else
      ++out.dropped;
  }
}

void World::Impl::scanTargets(core::Step& out)
{
  const SensorSetup& sensor = scenario.targetSensor;
  std::map<int, Point2D> places;
  for (const auto& [id, pose] : bodies.presentTargets()) places[id] = {pose.x, pose.y};
  out.blobs.emplace().fov = sensor.fov;
  for (const Seen& seen : scan(sensor, places, Purpose::kTargetSensing, Purpose::kTargetClutter))
  {
    const bool clutter = seen.object == core::kNoId;
    const std::string& label =
        clutter ? sensor.clutterLabel : scenario.targets.at(seen.object).label;
    if (usable(sensor, seen) || raw)
      out.blobs->blobs.push_back(toBlob(sensor, seen, label));
    else
      ++out.dropped;
  }
}

World::World(const Scenario& scenario, std::uint64_t seed, Sightings sightings)
    : impl_(std::make_unique<Impl>(scenario, seed, sightings == Sightings::kRaw))
{
}
World::~World() = default;

std::optional<core::Step> World::next()
{
  Impl& w = *impl_;
  if (w.bodies.step() >= w.scenario.steps) return std::nullopt;
  core::Step out;
  out.odometry = w.bodies.move();
  out.time = w.time();
  w.recordPoses();
  if (w.bodies.step() % w.scenario.scanEvery == 0)
  {
    w.scanLandmarks(out);
    w.scanTargets(out);
  }
  return out;
}

double World::progress() const
{
  return double(impl_->bodies.step()) / impl_->scenario.steps;
}
const core::Starts& World::starts() const
{
  return impl_->starts;
}
const eval::Truth& World::truth() const
{
  return impl_->truth;
}
}  // namespace slamot::sim
