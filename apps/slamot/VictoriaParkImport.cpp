#include "VictoriaParkImport.h"

#include "importOptions.h"

namespace slamot::apps
{
namespace
{
void addCalibration(CLI::App& command, importers::VictoriaParkOptions& o)
{
  addDegrees(command, "--steering-offset", o.steeringOffset, "Added to the logged steering [deg]")
      ->check(CLI::Range(-20.0, 20.0))
      ->type_name("DEG");
  command.add_option("--steering-scale", o.steeringScale, "Multiplies the logged steering first")
      ->check(CLI::Range(0.5, 2.0))
      ->capture_default_str()
      ->type_name("F");
  addDegrees(command, "--laser-yaw", o.laserYaw, "The laser is turned to the left by [deg]")
      ->check(CLI::Range(-20.0, 20.0))
      ->type_name("DEG");
}

void addNoise(CLI::App& command, importers::VictoriaParkOptions& o)
{
  const std::vector<CLI::Option*> options = {
      command.add_option("--std-speed", o.noise.speed, "Speed, part of it, held for 1 m"),
      addDegrees(command, "--std-steering", o.noise.steering, "Steering [deg], held for 1 m"),
      command.add_option("--std-trunk", o.trunkStd,
                         "A trunk's middle, along and across the ray [m]")};
  for (CLI::Option* option : options)
    option->type_name("STD")->check(CLI::Range(0.0, 1e3))->capture_default_str();
}
}  // namespace

void VictoriaParkImport::addTo(CLI::App& command)
{
  command.add_flag("--lasers", options.lasers, "The laser scans too, not only their trees");
  addCalibration(command, options);
  addNoise(command, options);
}
}  // namespace slamot::apps
