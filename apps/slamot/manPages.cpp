#include <slamot/core/Error.h>
#include <slamot/core/version.h>

#include <filesystem>
#include <fstream>
#include <regex>

#include "Command.h"
#include "commandLine.h"
#include "troff.h"

namespace slamot::apps
{
namespace
{
using troff::bold;
using troff::entry;
using troff::escaped;
using troff::italic;

std::string namesOf(const CLI::Option& option)
{
  std::string out;
  for (const std::string& name : option.get_snames()) out += ", " + bold("-" + name);
  for (const std::string& name : option.get_lnames()) out += ", " + bold("--" + name);
  return out.substr(2);
}

std::string textOf(const CLI::Option& option)
{
  std::string text = option.get_description();
  const auto add = [&](const std::string& more)
  { text += (text.empty() || text.back() == '.' ? " " : ". ") + more; };
  const ValueKind kind = valueKindOf(option);
  if (!kind.range.empty()) add("From " + kind.range);
  if (!option.get_default_str().empty()) add("Default " + option.get_default_str());
  for (const CLI::Option* other : option.get_excludes()) add("Not with " + other->get_name());
  return text + (text.back() == '.' ? "" : ".");
}

std::string synopsis(const CLI::App& command)
{
  std::string out = "[" + italic("OPTION") + "]...";
  for (const CLI::App* group : groupsOf(command))
    for (const CLI::Option* option : optionsOf(*group))
      if (option->get_required())
        out += " " + bold(option->get_name()) + " " + italic(valueKindOf(*option).name);
  for (const CLI::Option* option : positionalsOf(command))
  {
    const std::string name =
        italic(valueKindOf(*option).name) + (isRepeatable(*option) ? "..." : "");
    out += option->get_required() ? " " + name : " [" + name + "]";
  }
  return out;
}

std::string options(const CLI::App& command)
{
  std::string out;
  for (const CLI::Option* option : positionalsOf(command))
    out += entry(italic(valueKindOf(*option).name), textOf(*option));
  for (const CLI::App* group : groupsOf(command))
  {
    if (group != &command) out += ".SS " + escaped(group->get_description()) + "\n";
    for (const CLI::Option* option : optionsOf(*group))
      out +=
          entry(namesOf(*option) + (isFlag(*option) ? "" : " " + italic(valueKindOf(*option).name)),
                textOf(*option));
  }
  return out;
}

/// As interface and main() have it.
const std::string& exitStatus()
{
  static const std::string kText =
      ".SH EXIT STATUS\n" + entry("0", "Done.") + entry("1", "A usage or configuration error.") +
      entry("2", "Unreadable input.") + entry("3", "Truncated input.") +
      entry("4", "Values in the input that make no sense.") +
      entry("5", "A limit on size or time exceeded.") + entry("6", "An internal error.") +
      entry("130", "Interrupted; what is whole by then is written, and marked.") +
      ".PP\nEvery error is one line on standard error: where, what, and how to mend it.\n";
  return kText;
}

/// Writes pages for a slamot whose shared files are in a folder.
class Manual
{
 public:
  Manual(const CLI::App& program, std::string folder, std::string shared)
      : program_(program), folder_(std::move(folder)), shared_(std::move(shared))
  {
  }

  void write() const
  {
    writePage(program_, "slamot", commands());
    for (const CLI::App* command : commandsOf(program_))
      writePage(*command, "slamot-" + command->get_name(), "");
  }

 private:
  void writePage(const CLI::App& command, const std::string& name, const std::string& more) const
  {
    const Description about = descriptionOf(command);
    std::string brief = about.brief;
    brief[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(brief[0])));
    const std::string call = name == "slamot" ? name : "slamot " + command.get_name();
    std::string text =
        ".TH " + escaped(name) + " 1 \"\" \"slamot " + kVersion +
        "\" \"User Commands\"\n.SH NAME\n" + escaped(name + " - " + brief) + "\n.SH SYNOPSIS\n" +
        bold(call) + " " +
        (more.empty() ? synopsis(command) : italic("COMMAND") + " [" + italic("OPTION") + "]...") +
        "\n.SH DESCRIPTION\n" + escaped(about.brief + ".") + "\n";
    for (const std::string& line : about.more) text += ".PP\n" + escaped(line) + "\n";
    text += more + ".SH OPTIONS\n" + options(command) + exitStatus() + files();
    text += ".SH EXAMPLES\n.EX\n";
    for (const std::string& line : about.examples) text += escaped(installed(line)) + "\n";
    text += ".EE\n.SH SEE ALSO\n" + seeAlso(more.empty());
    std::ofstream file(std::filesystem::path(folder_) / (name + ".1"));
    if (!(file << text << std::flush))
      throw core::Error(core::ExitStatus::kConfig, folder_, "can't be written",
                        "give a folder that is there");
  }

  [[nodiscard]] std::string commands() const
  {
    std::string out =
        ".SH COMMANDS\nEach has a page of its own: slamot\\-" + italic("COMMAND") + "(1).\n";
    for (const CLI::App* command : commandsOf(program_))
      out += entry(bold(command->get_name()), descriptionOf(*command).brief + ".");
    return out;
  }

  [[nodiscard]] std::string files() const
  {
    return ".SH FILES\n" +
           entry(italic(shared_ + "/config-ini/"),
                 "Configurations, one for each method and experiment, every key commented.") +
           entry(italic(shared_ + "/datasets/"), "Rawlogs, with their ground truth.") +
           entry(italic("X.truth/"), "Ground truth of X.rawlog, beside it; filters never see it.") +
           entry(italic("slamot-out/"), "Where results go if nothing else is said.");
  }

  [[nodiscard]] std::string seeAlso(bool ofCommand) const
  {
    std::string out = ofCommand ? bold("slamot") + "(1)" : "";
    if (!ofCommand)
      for (const CLI::App* command : commandsOf(program_))
        out += (out.empty() ? "" : ",\n") + bold("slamot-" + command->get_name()) + "(1)";
    for (const char* other : {"RawLogViewer", "SceneViewer3D", "rawlog-edit"})
      out += ",\n" + bold(other) + "(1)";
    return out + "\n";
  }

  /// An example's files where they are installed, so that it can be tried as it stands.
  [[nodiscard]] std::string installed(const std::string& line) const
  {
    static const std::regex kConfig("(^| )config-ini/"), kDatasets("(^| )share/datasets/");
    return std::regex_replace(std::regex_replace(line, kConfig, "$1" + shared_ + "/config-ini/"),
                              kDatasets, "$1" + shared_ + "/datasets/");
  }

  const CLI::App& program_;
  std::string folder_, shared_;
};
}  // namespace

void addManPages(CLI::App& app, int& status)
{
  auto folder = std::make_shared<std::string>(), shared = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("__man", "Write the manual pages to a folder")->group("");
  command->add_option("folder", *folder)->required();
  command->add_option("shared", *shared, "Where config-ini/ and datasets/ are installed")
      ->required();
  command->callback(
      [folder, shared, &app, &status]
      {
        Manual(app, *folder, *shared).write();
        status = static_cast<int>(core::ExitStatus::kDone);
      });
}
}  // namespace slamot::apps
