#pragma once

#include <slamot/importers/ScaledCars.h>

#include <CLI/CLI.hpp>

namespace slamot::apps
{
/// What `slamot import scaled-cars` is asked for.
struct ScaledCarsImport
{
  importers::ScaledCarsOptions options;

  void addTo(CLI::App& command);
};
}  // namespace slamot::apps
