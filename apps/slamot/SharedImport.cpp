#include "SharedImport.h"

#include <slamot/core/Error.h>

#include <algorithm>
#include <cstdio>

#include "importOptions.h"

namespace slamot::apps
{
namespace
{
const std::string kMrclam = "mrclam", kPark = "victoria-park", kCarmen = "carmen",
                  kCars = "scaled-cars";
constexpr double kDegree = math::kPi / 180;

std::string defaults(const std::vector<std::string>& kinds, const std::vector<double*>& values,
                     double factor)
{
  std::string out;
  for (std::size_t i = 0; i < kinds.size(); ++i)
  {
    char text[32];
    std::snprintf(text, sizeof text, " %.4g", *values[i] / factor);
    out += (i ? ", " : " (") + kinds[i] + text;
  }
  return out + ")";
}
}  // namespace

/// \param values one for each kind, which hold their defaults.
void SharedImport::addNumber(CLI::App& command, const Kinds& kinds, const std::string& name,
                             const std::vector<double*>& values, const std::string& what,
                             double factor)
{
  const auto set = [values, factor](double v)
  { std::for_each(values.begin(), values.end(), [&](double* to) { *to = factor * v; }); };
  CLI::Option* option =
      command.add_option_function<double>(name, set, what + defaults(kinds, values, factor));
  options_.emplace_back(option, kinds);
  const bool isStd = name.rfind("--std-", 0) == 0, isTime = name == "--laser-delay";
  option->type_name(isStd ? "STD" : isTime ? "S" : "M");
  option->check(isStd    ? CLI::Range(0.0, 1e3)
                : isTime ? CLI::Range(-1.0, 1.0)
                         : CLI::Range(0.1, 1e3));
}

void SharedImport::addSensor(CLI::App& command, KindImports& k)
{
  auto& mrclam = k.mrclam.options;
  auto& park = k.park.options;
  addNumber(command, {kMrclam, kPark}, "--std-range-scale",
            {&mrclam.rangeScaleStd, &park.rangeScaleStd},
            "Ranges, part of the range, added in squares");
  addNumber(command, {kMrclam, kPark}, "--std-bearing", {&mrclam.bearingStd, &park.bearingStd},
            "Bearings [deg]", kDegree);
}

void SharedImport::addOdometry(CLI::App& command, KindImports& k)
{
  auto &mrclam = k.mrclam.options.wheels, &cars = k.cars.options.wheels;
  auto& carmen = k.carmen.options.noise;
  addNumber(command, {kMrclam, kCars}, "--std-distance", {&mrclam.distance, &cars.distance},
            "Odometry's distance [m/sqrt(s)]");
  addNumber(command, {kMrclam, kCarmen, kCars}, "--std-distance-turning",
            {&mrclam.distanceTurning, &carmen.distanceTurning, &cars.distanceTurning},
            "The same while turning [m/sqrt(rad turned)]");
  addNumber(command, {kMrclam, kCars}, "--std-heading", {&mrclam.heading, &cars.heading},
            "Odometry's heading [deg/sqrt(s)]", kDegree);
  addNumber(command, {kMrclam, kCarmen, kCars}, "--std-heading-turning",
            {&mrclam.headingTurning, &carmen.headingTurning, &cars.headingTurning},
            "The same while turning [rad/sqrt(rad turned)]");
  addNumber(command, {kPark, kCarmen}, "--std-slip", {&k.park.options.noise.slip, &carmen.slip},
            "Direction of driving against the robot's [deg], held for 1 m", kDegree);
  CLI::Option* start = command.add_option_function<std::string>(
      "--start",
      [&k](const std::string& where)
      {
        k.mrclam.start = where;
        k.cars.options.startFromTruth = where == "truth";
      },
      "Where the robot starts: at its true pose or the origin (mrclam, scaled-cars)");
  start->check(CLI::IsMember({"truth", "origin"}))->default_str("truth");
  options_.emplace_back(start, Kinds{kMrclam, kCars});
}

void SharedImport::addLaser(CLI::App& command, KindImports& k)
{
  auto& park = k.park.options;
  auto& carmen = k.carmen.options;
  auto& cars = k.cars.options;
  addNumber(command, {kPark, kCarmen, kCars}, "--max-range",
            {&park.maxRange, &carmen.maxRange, &cars.maxRange},
            "What is farther is left out, or no return [m]");
  addNumber(command, {kPark, kCars}, "--laser-delay", {&park.laserDelay, &cars.laserDelay},
            "Scans were taken before their times by [s]");
  const CLI::Option* mount = addPose(
      command, "--laser-mount",
      [&k](const Pose2D& pose)
      {
        k.carmen.options.mount = pose;
        k.cars.options.mount = pose;
      },
      "Where the laser is on the robot [m, m, deg] (carmen as logged or 0,0,0, scaled-cars "
      "-0.12,0,0)");
  options_.emplace_back(mount, Kinds{kCarmen, kCars});
}

void SharedImport::addTo(CLI::App& command, KindImports& kinds)
{
  addSensor(command, kinds);
  addOdometry(command, kinds);
  addLaser(command, kinds);
}

void SharedImport::check(const std::string& kind) const
{
  for (const auto& [option, kinds] : options_)
    if (option->count() > 0 && std::find(kinds.begin(), kinds.end(), kind) == kinds.end())
      throw core::Error(core::ExitStatus::kConfig, "command line",
                        option->get_name() + " is an option of " + enumerate(kinds), "remove it");
}
}  // namespace slamot::apps
