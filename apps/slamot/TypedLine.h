#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace slamot::apps
{
/// A command line up to the cursor, as far as it is understood.
class TypedLine
{
 public:
  /// \param words after the program's name; the last is typed just now.
  TypedLine(const CLI::App& program, std::vector<std::string> words);

  [[nodiscard]] bool isAtCommand() const { return !hasCommand_; }
  [[nodiscard]] const CLI::App& command() const { return *command_; }
  /// The option whose value is typed, or null.
  [[nodiscard]] const CLI::Option* valueOf() const { return valueOf_; }
  /// What takes the next word without dashes, or null.
  [[nodiscard]] const CLI::Option* positional() const;
  /// Neither there already, nor of a group that is named after another choice than the one made.
  [[nodiscard]] bool mayCome(const CLI::Option& option, const CLI::App& group) const;
  [[nodiscard]] const std::string& typed() const { return typed_; }
  /// What of the current word is no part of the value, such as `--align=`.
  [[nodiscard]] const std::string& before() const { return before_; }
  /// The first ini file on the line, or empty.
  [[nodiscard]] std::string config() const;

 private:
  [[nodiscard]] const CLI::Option* option(const std::string& name) const;
  [[nodiscard]] bool isOfOther(const CLI::App& group) const;
  void take(const std::string& word);
  void takeOption(const std::string& word);
  void takeCommand(const std::string& word);

  const CLI::App* command_;
  const CLI::Option* valueOf_ = nullptr;
  std::vector<const CLI::Option*> used_;
  std::vector<std::string> positionals_;
  std::string typed_, before_;
  bool hasCommand_ = false;
};
}  // namespace slamot::apps
