#pragma once

#include <slamot/importers/VictoriaPark.h>

#include <CLI/CLI.hpp>

namespace slamot::apps
{
/// What `slamot import victoria-park` is asked for.
struct VictoriaParkImport
{
  importers::VictoriaParkOptions options;

  void addTo(CLI::App& command);
};
}  // namespace slamot::apps
