#pragma once

#include <slamot/importers/Carmen.h>

#include <CLI/CLI.hpp>

namespace slamot::apps
{
/// What `slamot import carmen` is asked for.
struct CarmenImport
{
  importers::CarmenOptions options;

  void addTo(CLI::App& command);
};
}  // namespace slamot::apps
