#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <utility>
#include <vector>

namespace slamot::apps
{
/// What may stand at the cursor.
struct Completion
{
  std::vector<std::pair<std::string, std::string>> words;  ///< and what each is
  std::vector<std::string> files;                          ///< patterns such as *.ini
  bool folders = false;                                    ///< folders alone
};

/// \param words of the command line after the program's name; the last is typed just now.
[[nodiscard]] Completion complete(const CLI::App& program, const std::vector<std::string>& words);
}  // namespace slamot::apps
