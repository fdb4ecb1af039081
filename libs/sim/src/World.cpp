#include <slamot/core/Error.h>
#include <slamot/sim/World.h>

#include "Bodies.h"
#include "Sensor.h"
#include "Surroundings.h"
#include "starts.h"

#include <algorithm>
#include <cmath>

namespace slamot::sim
{
struct World::Impl
{
  Impl(const Scenario& s, std::uint64_t seedGiven, bool rawSightings, int robotIndex);

  // Whole ticks of 100 ns, as a rawlog holds them.
  [[nodiscard]] double time() const
  {
    return std::round((scenario.startTime + bodies.elapsed()) * 1e7) / 1e7;
  }
  [[nodiscard]] std::vector<Seen> scan(const SensorSetup& sensor,
                                       const std::map<int, Point2D>& objects, Purpose sensing,
                                       Purpose clutter) const
  {
    return sense(
        sensor, bodies.robot(robot), objects,
        {seed, sensing, clutter, static_cast<std::uint64_t>(bodies.step()), robotKey(robot)});
  }
  void scanLandmarks(core::Step& out);
  void addBlob(core::Step& out, const SensorSetup& sensor, const Seen& seen,
               const std::string& label) const;
  void scanTargets(core::Step& out) const;
  void scanMates(core::Step& out) const;
  void scanBlobs(core::Step& out) const;
  [[nodiscard]] Surroundings surroundings() const;
  [[nodiscard]] const RobotSetup& setup() const { return scenario.robots[std::size_t(robot)]; }
  void recordPoses();

  Scenario scenario;
  std::uint64_t seed;
  bool raw;
  int robot;
  Bodies bodies;
  core::Starts starts;
  eval::Truth truth;
};

World::Impl::Impl(const Scenario& s, std::uint64_t seedGiven, bool rawSightings, int robotIndex)
    : scenario(s),
      seed(seedGiven),
      raw(rawSightings),
      robot(robotIndex),
      bodies(s, seedGiven),
      starts(bodies.starts(robotIndex))
{
  starts.time = time();
  truth.landmarks = placeLandmarks(s, seed);
  recordPoses();
}

void World::Impl::recordPoses()
{
  truth.robot.poses.push_back({time(), bodies.robot(robot), true});
  for (const auto& [id, pose] : bodies.presentTargets())
    truth.targets[id].poses.push_back({time(), pose, true, bodies.targetVelocity(id)});
}

void World::Impl::scanLandmarks(core::Step& out)
{
  const SensorSetup& sensor = scenario.landmarkSensor;
  out.landmarks.emplace().fov = sensor.fov;
  int index = 0;
  for (const Seen& seen :
       scan(sensor, truth.landmarks, Purpose::kLandmarkSensing, Purpose::kLandmarkClutter))
  {
    const bool kept = usable(sensor, sensor.fov, seen);
    if (kept) truth.associations.push_back({out.time, index++, seen.object});
    if (kept || raw)
      out.landmarks->sightings.push_back(toSighting(sensor, seen));
    else
      ++out.dropped;
  }
}

void World::Impl::addBlob(core::Step& out, const SensorSetup& sensor, const Seen& seen,
                          const std::string& label) const
{
  if (usable(sensor, out.blobs->fov, seen) || raw)
    out.blobs->blobs.push_back(toBlob(sensor, seen, label));
  else
    ++out.dropped;
}

void World::Impl::scanTargets(core::Step& out) const
{
  const SensorSetup& sensor = *scenario.targetSensor;
  std::map<int, Point2D> places;
  for (const auto& [id, pose] : bodies.presentTargets()) places[id] = {pose.x, pose.y};
  for (const Seen& seen : scan(sensor, places, Purpose::kTargetSensing, Purpose::kTargetClutter))
  {
    const bool clutter = seen.object == core::kNoId;
    addBlob(out, sensor, seen,
            clutter ? sensor.clutterLabel : scenario.targets.at(seen.object).label);
  }
}

void World::Impl::scanMates(core::Step& out) const
{
  const SensorSetup& sensor = *scenario.mateSensor;
  for (const Seen& seen :
       scan(sensor, bodies.matesOf(robot), Purpose::kMateSensing, Purpose::kMateClutter))
    addBlob(out, sensor, seen, seen.object == core::kNoId ? sensor.clutterLabel : sensor.label);
  std::stable_sort(out.blobs->blobs.begin(), out.blobs->blobs.end(),
                   [](const core::Blob& a, const core::Blob& b) { return a.bearing < b.bearing; });
}

void World::Impl::scanBlobs(core::Step& out) const
{
  if (!scenario.targetSensor) return;
  out.blobs.emplace().fov = blobView(scenario);
  scanTargets(out);
  if (scenario.mateSensor) scanMates(out);
}

Surroundings World::Impl::surroundings() const
{
  Surroundings out;
  out.add(scenario.walls);
  for (const auto& [_, at] : truth.landmarks) out.add(at, scenario.landmarks.look);
  for (const auto& [id, pose] : bodies.presentTargets())
    out.add({pose.x, pose.y}, scenario.targets.at(id).look);
  for (const auto& [mate, at] : bodies.matesOf(robot))
    out.add(at, scenario.robots[static_cast<std::size_t>(mate)].look);
  return out;
}

World::World(const Scenario& scenario, std::uint64_t seed, Sightings sightings, int robot)
{
  if (robot < 0 || robot >= static_cast<int>(scenario.robots.size()))
    throw core::Error(core::ExitStatus::kConfig, scenario.name,
                      "has no robot " + std::to_string(robot), "add its section");
  impl_ = std::make_unique<Impl>(scenario, seed, sightings == Sightings::kRaw, robot);
}
World::~World() = default;

std::optional<core::Step> World::next()
{
  Impl& w = *impl_;
  if (w.bodies.step() >= w.scenario.steps) return std::nullopt;
  core::Step out;
  out.odometry = w.bodies.move()[std::size_t(w.robot)];
  out.time = w.time();
  w.recordPoses();
  const auto step = static_cast<std::uint64_t>(w.bodies.step());
  if (const auto& laser = w.setup().laser; laser && w.bodies.step() % laser->every == 0)
    out.lasers.push_back(std::make_shared<core::LaserScan>(
        castScan(w.surroundings(), w.bodies.robot(w.robot), *laser,
                 stream(w.seed, Purpose::kLaser, step, robotKey(w.robot)))));
  if (w.scenario.sightings && w.bodies.step() % w.scenario.scanEvery == 0)
  {
    w.scanLandmarks(out);
    w.scanBlobs(out);
  }
  return out;
}

std::optional<Picture> World::picture() const
{
  const Impl& w = *impl_;
  const int step = w.bodies.step();
  const auto& camera = w.setup().camera;
  if (!camera || step == 0 || step % camera->every != 0) return std::nullopt;
  return drawPicture(
      w.surroundings(), w.bodies.robot(w.robot), *camera, w.bodies.elapsed(),
      stream(w.seed, Purpose::kCamera, static_cast<std::uint64_t>(step), robotKey(w.robot)));
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
