#pragma once

#include <slamot/importers/Mrclam.h>

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace slamot::apps
{
/// What `slamot import mrclam` is asked for.
struct MrclamImport
{
  importers::MrclamOptions options;  ///< of the robot, or of all robots of the team
  std::string start = "truth";
  bool team = false;        ///< all robots but options.target
  std::vector<int> hidden;  ///< robots of the team that are to see no landmarks

  void addTo(CLI::App& command);
  /// \throws core::Error (kConfig) on options that do not go together.
  void check(const CLI::App& command) const;
  /// The options of one robot.
  [[nodiscard]] importers::MrclamOptions of(int robot) const;
};
}  // namespace slamot::apps
