#include "MrclamImport.h"

#include <slamot/core/Error.h>

#include <algorithm>

namespace slamot::apps
{
namespace
{
using core::Error;
using core::ExitStatus;

void addSensorOptions(CLI::App& command, MrclamImport& o)
{
  importers::MrclamOptions& m = o.options;
  command.add_option("--std-range", m.rangeStd, "Ranges [m]")
      ->type_name("STD")
      ->check(CLI::Range(0.0, 1e3))
      ->capture_default_str();
}

void addTeamOptions(CLI::App& command, MrclamImport& o)
{
  command.add_flag("--team", o.team, "A log for each robot but the target, X.robot<k>.rawlog");
  command
      .add_option_function<int>(
          "--target", [&o](int robot) { o.options.target = robot; },
          "Of a team: the robot that the others track, 1 to 5; its blobs are labelled target")
      ->check(CLI::Range(1, importers::kMrclamRobots))
      ->type_name("N");
  command
      .add_option("--hide-landmarks", o.hidden,
                  "Of a team: robots that are to have no landmark sightings")
      ->check(CLI::Range(1, importers::kMrclamRobots))
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("K,L");
}

[[noreturn]] void fail(const std::string& what, const std::string& mend)
{
  throw Error(ExitStatus::kConfig, "command line", what, mend);
}

void checkAlone(const CLI::App& command)
{
  for (const char* option : {"--target", "--hide-landmarks"})
    if (command.count(option) > 0) fail(std::string(option) + " is for a team", "add --team");
  if (command.count("--robot") == 0) fail("mrclam needs a robot", "add --robot N, 1 to 5");
}
}  // namespace

void MrclamImport::addTo(CLI::App& command)
{
  importers::MrclamOptions& m = options;
  command.add_option("--robot", m.robot, "Whose data, 1 to 5 (this or --team is required)")
      ->check(CLI::Range(1, 5))
      ->type_name("N");
  command.add_flag("--landmark-ids,!--no-landmark-ids", m.landmarkIds,
                   "Sightings tell which landmark they are of (default), or not");
  command.add_flag("--target-ids,!--no-target-ids", m.targetIds,
                   "Blobs tell which robot they are of (default), or not");
  command.add_option("--max-step", m.maxStep, "Longest step between camera images [s]")
      ->check(CLI::Range(1e-3, 1e3))
      ->capture_default_str()
      ->type_name("S");
  command
      .add_option("--odometry-delay", m.odometryDelay, "Motion follows logged velocities by [s]")
      ->check(CLI::Range(-10.0, 10.0))
      ->capture_default_str()
      ->type_name("S");
  addTeamOptions(command, *this);
  addSensorOptions(command, *this);
}

void MrclamImport::check(const CLI::App& command) const
{
  if (!team) return checkAlone(command);
  if (command.count("--robot") > 0) fail("--robot is one robot and --team are all", "remove one");
  if (!options.target) fail("--team needs a target", "add --target N, 1 to 5");
  if (start == "origin") fail("--start origin leaves a team without a common frame", "remove it");
  if (std::find(hidden.begin(), hidden.end(), *options.target) != hidden.end())
    fail("--hide-landmarks names the target, which has no log", "name other robots");
}

importers::MrclamOptions MrclamImport::of(int robot) const
{
  importers::MrclamOptions out = options;
  out.robot = robot;
  out.startFromTruth = start == "truth";
  out.hideLandmarks = std::find(hidden.begin(), hidden.end(), robot) != hidden.end();
  return out;
}
}  // namespace slamot::apps
