#include <slamot/sim/Scenario.h>

#include <slamot/core/Error.h>

#include <algorithm>
#include <charconv>

namespace slamot::sim
{
namespace
{
constexpr int kMostSteps = 10'000'000;
constexpr int kMostLandmarks = 100'000;
constexpr double kMostClutter = 500;  // what the Poisson draw is good for

StartKnowledge readStartKnowledge(core::Params& p)
{
  StartKnowledge out;
  out.known = p.flag("start_known", out.known);
  out.std[0] = p.nonNegative("start_std_x_m", 0.0);
  out.std[1] = p.nonNegative("start_std_y_m", 0.0);
  out.std[2] = p.nonNegative("start_std_theta_rad", 0.0);
  out.velocityStd = p.optionalNumber("start_std_velocity_mps", 0.0);
  return out;
}

// The id that a section's name gives a target; none for other sections.
std::optional<int> targetId(const std::string& section)
{
  if (section == "target") return 1;
  const std::string prefix = "target_";
  if (section.rfind(prefix, 0) != 0) return std::nullopt;
  int id = 0;
  std::from_chars(section.data() + prefix.size(), section.data() + section.size(), id);
  if (id < 0 || section != prefix + std::to_string(id)) return std::nullopt;
  return id;
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

std::map<int, TargetSetup> readTargets(core::Config& config, const Area& area)
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
    target.start = readStartKnowledge(p);
    target.label = p.text("label", target.label);
    target.present = readPresence(p);
    if (!out.emplace(*id, target).second)
      throw core::Error(core::ExitStatus::kConfig, config.name() + " [" + section + "]",
                        "is target 1, as [target] is", "give it another number");
  }
  return out;
}

RobotSetup readRobot(core::Config& config, const Area& area,
                     const std::map<int, TargetSetup>& targets)
{
  core::Params p(config, "robot");
  RobotSetup r;
  r.motion = Motion::from(p, area);
  r.start = readStartKnowledge(p);
  r.following = p.flag("following", false);
  r.followed =
      p.integer("follow_target", 0, 1'000'000, targets.empty() ? 1 : targets.begin()->first);
  r.followDistance = p.nonNegative("follow_distance_m", r.followDistance);
  r.followGain = p.positive("follow_gain_per_s", r.followGain);
  r.followSpeedRatio = p.positive("follow_speed_ratio", 1.2);
  const bool nearTarget = r.motion.startAt == Motion::StartAt::kNearTarget;
  if (r.following && !targets.count(r.followed))
    p.fail("follow_target", "there is no target " + std::to_string(r.followed), "add its section");
  if (nearTarget && targets.empty())
    p.fail("start", "near_target, but there is none", "add [target]");
  return r;
}

SensorSetup readSensor(core::Params& p)
{
  SensorSetup s;
  s.fov.rangeMin = p.nonNegative("range_min_m", 0.0);
  s.fov.rangeMax = p.positive("range_max_m");
  if (s.fov.rangeMax <= s.fov.rangeMin)
    p.fail("range_max_m", "is not above range_min_m", "raise it");
  s.fov.bearingMin = p.inRange("bearing_min_deg", -180, 180, -math::kPi);
  s.fov.bearingMax = p.inRange("bearing_max_deg", -180, 180, math::kPi);
  if (s.fov.bearingMax <= s.fov.bearingMin)
    p.fail("bearing_max_deg", "is not above bearing_min_deg", "raise it");
  s.rangeStd = p.positive("range_std_m");
  s.bearingStd = p.positive("bearing_std_rad");
  s.detection = p.inRange("detection_probability", 0, 1, 1.0);
  s.clutter = p.inRange("clutter_per_scan", 0, kMostClutter, 0.0);
  s.identities = p.flag("identities", true);
  return s;
}

void readLandmarks(core::Params& p, Scenario& s)
{
  s.landmarks = p.integer("landmarks", 0, kMostLandmarks, 0);
  s.landmarkSpacing = p.nonNegative("landmark_spacing_min_m", 0.0);
  if (!p.has("landmark_positions_m")) return;
  if (s.landmarks > 0)
    p.fail("landmark_positions_m", "given beside landmarks", "keep one of the two");
  const auto numbers = p.numbers("landmark_positions_m");
  if (numbers.size() % 2 != 0)
    p.fail("landmark_positions_m", "has an x without y", "write x1, y1, x2, y2, ...");
  for (std::size_t i = 0; i < numbers.size(); i += 2)
    s.landmarkPositions.emplace_back(numbers[i], numbers[i + 1]);
}
}  // namespace

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
  readLandmarks(world, s);
  s.targets = readTargets(config, s.area);
  s.robot = readRobot(config, s.area, s.targets);
  core::Params landmarkSensor(config, "landmark_sensor"), targetSensor(config, "target_sensor");
  s.landmarkSensor = readSensor(landmarkSensor);
  s.targetSensor = readSensor(targetSensor);
  s.targetSensor.bearingOnly = targetSensor.flag("bearing_only", false);
  s.targetSensor.clutterLabel = targetSensor.text("clutter_label", "target");
  return s;
}
}  // namespace slamot::sim
