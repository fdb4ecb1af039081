#include "importOptions.h"

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

CLI::Option* addPose(CLI::App& command, const std::string& name,
                     std::function<void(const Pose2D&)> set, const std::string& what)
{
  return command
      .add_option_function<std::vector<double>>(
          name,
          [set = std::move(set)](const std::vector<double>& v) {
            set({v[0], v[1], math::wrapToPi(math::degToRad(v[2]))});
          },
          what)
      ->delimiter(',')
      ->expected(3)
      ->check(CLI::Range(-360.0, 360.0))
      ->type_name("X,Y,DEG");
}

std::string enumerate(const std::vector<std::string>& names)
{
  std::string out;
  for (std::size_t i = 0; i < names.size(); ++i)
    out += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  return out;
}
}  // namespace slamot::apps
