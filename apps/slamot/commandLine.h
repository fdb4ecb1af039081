#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

// What the program's command line consists of, for those who tell of it: manual pages, completion.
namespace slamot::apps
{
/// Its commands, in the order of its help; hidden ones are not among them.
[[nodiscard]] std::vector<const CLI::App*> commandsOf(const CLI::App& program);
/// A command, and its groups of options.
[[nodiscard]] std::vector<const CLI::App*> groupsOf(const CLI::App& command);
/// Options with dashes of a command or group.
[[nodiscard]] std::vector<const CLI::Option*> optionsOf(const CLI::App& group);
/// What a command takes without dashes, in its order.
[[nodiscard]] std::vector<const CLI::Option*> positionalsOf(const CLI::App& command);

[[nodiscard]] bool isFlag(const CLI::Option& option);
[[nodiscard]] bool isRepeatable(const CLI::Option& option);

/// What an option's value is called and may be; of "N:INT in [1 - 5]", N and the range "1 to 5".
struct ValueKind
{
  std::string name, range;
  std::vector<std::string> choices;  ///< empty: not one of a few
};
[[nodiscard]] ValueKind valueKindOf(const CLI::Option& option);

/// A command's description, taken apart.
struct Description
{
  std::string brief;                  ///< its first line or sentence, without the full stop
  std::vector<std::string> more;      ///< lines before the examples
  std::vector<std::string> examples;  ///< command lines
};
[[nodiscard]] Description descriptionOf(const CLI::App& command);
}  // namespace slamot::apps
