#include <slamot/sim/Scenario.h>

#include <slamot/core/Error.h>

#include <algorithm>

#include "AcceleratedPoint.h"
#include "readSections.h"

namespace slamot::sim
{
namespace
{
constexpr int kMostSteps = 10'000'000;

// The id that a section's name gives a target; none for other sections.
std::optional<int> targetId(const std::string& section)
{
  if (section == "target") return 1;
  return numberOf(section, "target_");
}

std::vector<std::pair<double, double>> readPresence(core::Params& p)
{
  std::vector<std::pair<double, double>> spans;
  if (!p.has("present_s")) return spans;
  const auto times = p.numbers("present_s");
  if (times.size() % 2 != 0)
    p.fail("present_s", "has a time without its partner", "write from, until, ...");
  for (std::size_t i = 0; i < times.size(); i += 2)
  {
    if (times[i + 1] <= times[i] || (i > 0 && times[i] < times[i - 1]))
      p.fail("present_s", "has times that do not rise", "write from, until, from, until, ...");
    spans.emplace_back(times[i], times[i + 1]);
  }
  return spans;
}

// Its pull on the point must be far slower than a step, or it is no longer mild.
void checkAcceleration(core::Params& p, const Motion& m, double dt)
{
  if (m.kind == Motion::Kind::kAccelerated && AcceleratedPoint::springRate(m) * dt > 0.5)
    p.fail("jerk_noise_mps3_per_sqrt_hz", "is too much for its speed's band and its cone",
           "lower it, or dt_s");
}

std::map<int, TargetSetup> readTargets(core::Config& config, const Area& area, double dt)
{
  std::map<int, TargetSetup> out;
  for (const std::string& section : config.sections())
  {
    const auto id = targetId(section);
    if (!id) continue;
    core::Params p(config, section);
    TargetSetup target;
    target.motion = Motion::from(p, area);
    if (target.motion.startAt == Motion::StartAt::kNearTarget)
      p.fail("start", "near_target is for robots", "set it to path, given or random");
    checkAcceleration(p, target.motion, dt);
    target.start = readStartKnowledge(p, target.motion);
    target.label = p.text("label", target.label);
    target.look = Look::from(p, target.look);
    target.present = readPresence(p);
    if (!out.emplace(*id, target).second)
      throw core::Error(core::ExitStatus::kConfig, config.name() + " [" + section + "]",
                        "is target 1, as [target] is", "give it another number");
  }
  return out;
}

std::vector<Wall> readWalls(core::Params& p)
{
  std::vector<Wall> out;
  if (!p.has("walls_m")) return out;
  const auto numbers = p.numbers("walls_m");
  if (numbers.size() % 4 != 0)
    p.fail("walls_m", "is not four numbers a wall", "write x1, y1, x2, y2, ...");
  for (std::size_t i = 0; i < numbers.size(); i += 4)
    out.push_back({{numbers[i], numbers[i + 1]}, {numbers[i + 2], numbers[i + 3]}});
  return out;
}

// A team's robot may have a section of its own in place of the one for all.
template <class Setup>
std::optional<Setup> readRaw(core::Config& config, const std::string& kind,
                             const std::string& robotSection)
{
  const auto number = numberOf(robotSection, "robot_");
  const std::string own = number ? kind + "_" + std::to_string(*number) : kind;
  const std::string section = config.has(own) ? own : kind;
  if (!config.has(section)) return std::nullopt;
  core::Params p(config, section);
  return Setup::from(p);
}
}  // namespace

StartKnowledge readStartKnowledge(core::Params& p, const Motion& motion)
{
  StartKnowledge out;
  out.known = p.flag("start_known", out.known);
  out.std[0] = p.nonNegative("start_std_x_m", 0.0);
  out.std[1] = p.nonNegative("start_std_y_m", 0.0);
  out.std[2] = p.nonNegative("start_std_theta_rad", 0.0);
  out.velocityStd = p.optionalNumber("start_std_velocity_mps", 0.0);
  out.accelerationStd = p.optionalNumber("start_std_acceleration_mps2", 0.0);
  if (out.accelerationStd && motion.kind != Motion::Kind::kAccelerated)
    p.fail("start_std_acceleration_mps2", "is for motion = accelerated", "remove it");
  if (out.std[2] > 0 && motion.kind == Motion::Kind::kWhiteAcceleration)
    p.fail("start_std_theta_rad", "is not for motion = white_acceleration, which has no heading",
           "set start_std_velocity_mps");
  return out;
}

bool TargetSetup::isPresent(double time) const
{
  return present.empty() ||
         std::any_of(present.begin(), present.end(),
                     [&](const auto& span) { return time >= span.first && time < span.second; });
}

Scenario Scenario::from(core::Config& config)
{
  Scenario s;
  s.name = config.name();
  core::Params world(config, "world");
  s.area.width = world.positive("width_m");
  s.area.height = world.positive("height_m");
  s.startTime = world.number("start_time_s", 0.0);
  s.dt = world.inRange("dt_s", 1e-4, 3600);
  s.steps = world.integer("steps", 1, kMostSteps);
  s.scanEvery = world.integer("scan_every", 1, kMostSteps, 1);
  s.targets = readTargets(config, s.area, s.dt);
  s.robots = readRobots(config, s.area, s.targets);
  s.landmarks = readLandmarks(world, s.robots);
  s.landmarkSensor = readLandmarkSensor(config);
  s.mateSensor = readMateSensor(config);
  s.sightings = world.flag("sightings", true);
  s.walls = readWalls(world);
  for (RobotSetup& robot : s.robots)
  {
    robot.laser = readRaw<LaserSetup>(config, "laser", robot.section);
    robot.camera = readRaw<CameraSetup>(config, "camera", robot.section);
  }
  s.targetSensor = readTargetSensor(config, !s.targets.empty() || s.mateSensor);
  return s;
}
}  // namespace slamot::sim
