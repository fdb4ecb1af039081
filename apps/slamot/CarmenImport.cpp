#include "CarmenImport.h"

#include "importOptions.h"

namespace slamot::apps
{
namespace
{
void addBeams(CLI::App& command, importers::CarmenOptions& o)
{
  addPose(
      command, "--rear-laser-mount", [&o](const Pose2D& pose) { o.rearMount = pose; },
      "Where RLASER, ROBOTLASER2 is on the robot [m, m, deg] (default as logged, or facing back)");
  command
      .add_option_function<double>(
          "--first-beam", [&o](double degrees) { o.firstBeam = math::degToRad(degrees); },
          "First beam of FLASER, RLASER [deg] (default by their number: -90, or -50 of 400)")
      ->check(CLI::Range(-360.0, 360.0))
      ->type_name("DEG");
  command
      .add_option_function<double>(
          "--beam-step", [&o](double degrees) { o.beamStep = math::degToRad(degrees); },
          "Between beams of FLASER, RLASER [deg] (default by their number: 1 of 180, 0.5 of 361)")
      ->check(CLI::Range(1e-3, 360.0))
      ->type_name("DEG");
}

void addNoise(CLI::App& command, importers::CarmenOptions& o)
{
  const std::vector<CLI::Option*> options = {
      command.add_option("--std-distance-driving", o.noise.distance,
                         "Odometry's distance [m/sqrt(m driven)]"),
      addDegrees(command, "--std-heading-driving", o.noise.heading,
                 "Odometry's heading [deg/sqrt(m driven)]")};
  for (CLI::Option* option : options)
    option->type_name("STD")->check(CLI::Range(0.0, 1e3))->capture_default_str();
}
}  // namespace

void CarmenImport::addTo(CLI::App& command)
{
  command
      .add_option("--relations", options.relations,
                  "Reference relations t1 t2 dx dy dz droll dpitch dyaw, to be the truth")
      ->type_name("FILE");
  command
      .add_option_function<std::string>(
          "--odometry",
          [this](const std::string& from) { options.odometryLines = from == "lines"; },
          "Poses of odometry: the scans' own, or between ODOM lines")
      ->check(CLI::IsMember({"scans", "lines"}))
      ->default_str("scans");
  addBeams(command, options);
  addNoise(command, options);
}
}  // namespace slamot::apps
