#include <slamot/laws/Drive.h>
#include <slamot/math/random.h>
#include <slamot/models/RangeBearing.h>

namespace slamot::laws
{
namespace
{
using math::RandomStream;
using models::RangeBearing;

/// Where a body is after one step of its motion with noise.
Pose2D moved(const Pose2D& pose, double v, double omega, double dt)
{
  return math::compose(pose, math::turnThenMove(v, omega, dt, 0, 0).mean);
}

std::vector<Point2D> scatterLandmarks(const World& world, const Pose2D& start, RandomStream& random)
{
  const double radius = world.turnRate == 0 ? 0 : world.speed / world.turnRate;
  std::vector<Point2D> points;
  for (int i = 0; i < world.landmarks; ++i)
  {
    const double x = random.uniform(-world.halfSide, world.halfSide);
    const double y = radius + random.uniform(-world.halfSide, world.halfSide);
    points.push_back(math::transform(start, {x, y}));
  }
  return points;
}

/// Target `id`: its true start, and what the filter is told of it.
Pose2D startTarget(const World& world, int id, const Pose2D& start, core::Starts& starts,
                   RandomStream& random)
{
  const Vector3 error = world.targetStartStd * random.normal3();
  const Pose2D known = math::compose(start, {3.0 + id, 1.0 - 2.0 * id, 0.5});
  core::ObjectStart& told = starts.targets[id];
  told.value = {known.x, known.y, known.phi, world.targetSpeed * std::cos(known.phi),
                world.targetSpeed * std::sin(known.phi)};
  told.std = {world.targetStartStd, world.targetStartStd, world.targetStartStd, 0.0, 0.0};
  return math::compose(known, {error[0], error[1], error[2]});
}

/// A noisy sighting, if it stays in view.
std::optional<Vector2> see(const World& world, const Pose2D& pose, const Point2D& point,
                           RandomStream& random)
{
  const Vector2 z = RangeBearing::predict(pose, point) +
                    Vector2(world.rangeStd * random.normal(), world.bearingStd * random.normal());
  if (z[0] <= 0.2 || z[0] > world.rangeMax) return std::nullopt;
  return Vector2(z[0], math::wrapToPi(z[1]));
}

void scan(const World& world, const Pose2D& robot, const std::vector<Point2D>& landmarks,
          const std::vector<Pose2D>& targets, core::Step& step, RandomStream& random)
{
  const core::FieldOfView fov{0.0, world.rangeMax, -math::kPi, math::kPi};
  step.landmarks = core::LandmarkScan{fov, {}};
  for (std::size_t i = 0; i < landmarks.size(); ++i)
    if (const auto z = see(world, robot, landmarks[i], random))
      step.landmarks->sightings.push_back({(*z)[0], (*z)[1], world.rangeStd, world.bearingStd,
                                           world.identities ? static_cast<int>(i) : core::kNoId});
  if (targets.empty()) return;
  step.blobs = core::BlobScan{fov, {}};
  for (std::size_t i = 0; i < targets.size(); ++i)
    if (const auto z = see(world, robot, {targets[i].x, targets[i].y}, random))
      step.blobs->blobs.push_back(
          {"target", (*z)[0], (*z)[1], world.rangeStd, world.bearingStd, static_cast<int>(i)});
}
}  // namespace

Drive drive(const World& world, std::uint64_t seed, const Pose2D& start)
{
  RandomStream random{seed, 0x6c617773};
  Drive out;
  out.starts.time = 0.0;
  out.starts.robot.emplace();
  out.starts.robot->value = {start.x, start.y, start.phi};
  const auto landmarks = scatterLandmarks(world, start, random);
  Pose2D robot = start;
  std::vector<Pose2D> targets;
  for (int id = 0; id < world.targets; ++id)
    targets.push_back(startTarget(world, id, start, out.starts, random));
  const double scale = 1 + world.speedScaleStd * random.normal();
  for (int i = 1; i <= world.steps; ++i)
  {
    const auto noisy = [&](double value, double std) { return value + std * random.normal(); };
    const double v = noisy(scale * world.speed, world.speedStd);
    robot = moved(robot, v, noisy(world.turnRate, world.turnRateStd), world.dt);
    for (Pose2D& target : targets)
    {
      const double vTarget = noisy(world.targetSpeed, world.targetSpeedStd);
      const double omega = noisy(world.targetTurnRate, world.targetTurnRateStd);
      target = moved(target, vTarget, omega, world.dt);
    }
    core::Step step;
    step.time = i * world.dt;
    step.odometry = math::turnThenMove(world.speed, world.turnRate, world.dt, world.speedStd,
                                       world.turnRateStd);
    if (i % world.scanEvery == 0) scan(world, robot, landmarks, targets, step, random);
    out.steps.push_back(std::move(step));
    out.robot.push_back(robot);
    out.targets.push_back(targets);
  }
  return out;
}
}  // namespace slamot::laws
