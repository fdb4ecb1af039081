#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

namespace slamot::apps
{
/// An option in degrees for a value kept in radians, whose default its help shows.
CLI::Option* addDegrees(CLI::App& command, const std::string& name, double& radians,
                        const std::string& what);

/// Options that several kinds of import have, each kind with its own default.
struct SensorImport
{
  std::optional<double> rangeScaleStd;  ///< part of the range
  std::optional<double> bearingStd;     ///< [rad]

  void addTo(CLI::App& command);
};
}  // namespace slamot::apps
