#include "importOptions.h"

#include <slamot/math/geometry.h>

#include <cstdio>

namespace slamot::apps
{
CLI::Option* addDegrees(CLI::App& command, const std::string& name, double& radians,
                        const std::string& what)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", math::radToDeg(radians));
  return command
      .add_option_function<double>(
          name, [&radians](double degrees) { radians = math::degToRad(degrees); }, what)
      ->default_str(text);
}

void SensorImport::addTo(CLI::App& command)
{
  command
      .add_option("--std-range-scale", rangeScaleStd,
                  "Ranges, part of the range, added in squares (mrclam 0.04, victoria-park 0.004)")
      ->type_name("STD")
      ->check(CLI::Range(0.0, 1e3));
  command
      .add_option_function<double>(
          "--std-bearing", [this](double degrees) { bearingStd = math::degToRad(degrees); },
          "Bearings [deg] (mrclam 0.8, victoria-park 0.2)")
      ->type_name("STD")
      ->check(CLI::Range(0.0, 1e3));
}
}  // namespace slamot::apps
