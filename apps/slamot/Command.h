#pragma once

#include <CLI/CLI.hpp>
#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

namespace slamot::apps
{
/// Options that all computing commands share.
struct CommonOptions
{
  std::string output;
  std::uint64_t seed = 1;
  bool seedGiven = false;
  int threads = 1;
  std::vector<std::string> set;      ///< Section.key=value
  std::vector<std::string> plugins;  ///< paths of shared libraries
  bool quiet = false, verbose = false;

  void addTo(CLI::App& command);
  /// \throws core::Error (kConfig) if one can't be loaded.
  void loadPlugins() const;
};

/// Set by Ctrl-C; commands end at the next step's boundary.
extern std::atomic<bool> interrupted;

// Each adds its subcommand; the callback returns the exit status through `status` and throws
// core::Error for what the user must mend.
void addInfo(CLI::App& app, int& status);
void addSimulate(CLI::App& app, int& status);
void addImport(CLI::App& app, int& status);
void addRun(CLI::App& app, int& status);
void addEvaluate(CLI::App& app, int& status);
void addRender(CLI::App& app, int& status);
void addStudy(CLI::App& app, int& status);
void addReproduce(CLI::App& app, int& status);
void addTeam(CLI::App& app, int& status);
void addRobot(CLI::App& app, int& status);
void addDetect(CLI::App& app, int& status);
void addCalibrateColor(CLI::App& app, int& status);
// Hidden: for shells, and for who packs.
void addComplete(CLI::App& app, int& status);
void addManPages(CLI::App& app, int& status);
}  // namespace slamot::apps
