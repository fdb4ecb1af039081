#include <slamot/core/Error.h>

#include <algorithm>
#include <charconv>

#include "readSections.h"

namespace slamot::sim
{
namespace
{
/// The sections of robots, by their number.
std::vector<std::string> robotSections(const core::Config& config)
{
  std::vector<int> numbers;
  for (const std::string& section : config.sections())
    if (const auto number = numberOf(section, "robot_")) numbers.push_back(*number);
  if (numbers.empty()) return {"robot"};
  std::sort(numbers.begin(), numbers.end());
  std::vector<std::string> out;
  for (const int number : numbers) out.push_back("robot_" + std::to_string(number));
  const auto fail = [&](const std::string& section, const std::string& what,
                        const std::string& mend) {
    throw core::Error(core::ExitStatus::kConfig, config.name() + " [" + section + "]", what, mend);
  };
  if (config.has("robot"))
    fail("robot", "is there beside [" + out[0] + "]", "name all robots robot_0, robot_1, ...");
  for (std::size_t i = 0; i < numbers.size(); ++i)
    if (numbers[i] != static_cast<int>(i))
      fail(out[i], "is there without [robot_" + std::to_string(i) + "]",
           "number robots from 0 without a gap");
  return out;
}

void readFollowing(core::Params& p, RobotSetup& r, const std::map<int, TargetSetup>& targets)
{
  r.following = p.flag("following", false);
  r.followed =
      p.integer("follow_target", 0, 1'000'000, targets.empty() ? 1 : targets.begin()->first);
  r.followSide = p.number("follow_side_m", 0.0);
  r.followDistance = p.nonNegative("follow_distance_m", r.followDistance);
  r.followGain = p.positive("follow_gain_per_s", r.followGain);
  r.followSpeedRatio = p.positive("follow_speed_ratio", 1.2);
  if (r.following && !targets.count(r.followed))
    p.fail("follow_target", "there is no target " + std::to_string(r.followed), "add its section");
  if (r.following && r.motion.drive == Motion::Drive::kSteering)
    p.fail("drive", "steering can't follow a target", "set it to turn_rate");
  if (!r.following && r.followSide != 0)
    p.fail("follow_side_m", "is given, but the robot follows nothing", "set following = true");
}

RobotSetup readRobot(core::Config& config, const std::string& section, const Area& area,
                     const std::map<int, TargetSetup>& targets)
{
  core::Params p(config, section);
  RobotSetup r;
  r.section = section;
  r.motion = Motion::from(p, area);
  if (r.motion.isPoint())
    p.fail("motion", p.text("motion") + " is for targets", "set it to one that wheels can drive");
  r.start = readStartKnowledge(p, r.motion);
  r.look = Look::from(p, r.look);
  readFollowing(p, r, targets);
  if (r.motion.startAt == Motion::StartAt::kNearTarget && targets.empty())
    p.fail("start", "near_target, but there is none", "add [target]");
  return r;
}
}  // namespace

std::optional<int> numberOf(const std::string& section, const std::string& prefix)
{
  if (section.rfind(prefix, 0) != 0) return std::nullopt;
  int number = 0;
  std::from_chars(section.data() + prefix.size(), section.data() + section.size(), number);
  if (number < 0 || section != prefix + std::to_string(number)) return std::nullopt;
  return number;
}

std::vector<RobotSetup> readRobots(core::Config& config, const Area& area,
                                   const std::map<int, TargetSetup>& targets)
{
  std::vector<RobotSetup> out;
  for (const std::string& section : robotSections(config))
    out.push_back(readRobot(config, section, area, targets));
  return out;
}
}  // namespace slamot::sim
