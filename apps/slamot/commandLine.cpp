#include "commandLine.h"

#include <regex>
#include <sstream>

namespace slamot::apps
{
namespace
{
/// The parts of a list in braces.
std::vector<std::string> choicesIn(const std::string& text)
{
  std::vector<std::string> out;
  const auto open = text.find('{'), close = text.find('}');
  if (open == std::string::npos || close == std::string::npos) return out;
  std::istringstream in(text.substr(open + 1, close - open - 1));
  for (std::string part; std::getline(in, part, ',');) out.push_back(part);
  return out;
}

std::string rangeIn(const std::string& text)
{
  static const std::regex kRange(R"(in \[(\S+) - (\S+)\])");
  std::smatch match;
  if (std::regex_search(text, match, kRange)) return match.str(1) + " to " + match.str(2);
  if (text.find("NONNEGATIVE") != std::string::npos) return "0 or more";
  return text.find("POSITIVE") != std::string::npos ? "above 0" : "";
}
}  // namespace

std::vector<const CLI::App*> commandsOf(const CLI::App& program)
{
  return program.get_subcommands([](const CLI::App* app)
                                 { return !app->get_name().empty() && !app->get_group().empty(); });
}

std::vector<const CLI::App*> groupsOf(const CLI::App& command)
{
  std::vector<const CLI::App*> out = {&command};
  for (const CLI::App* group :
       command.get_subcommands([](const CLI::App* app) { return app->get_name().empty(); }))
    out.push_back(group);
  return out;
}

std::vector<const CLI::Option*> optionsOf(const CLI::App& group)
{
  // CLI gives each group a --help of its own.
  const CLI::Option* const again = group.get_name().empty() ? group.get_help_ptr() : nullptr;
  return group.get_options([&](const CLI::Option* o)
                           { return o->nonpositional() && !o->get_group().empty() && o != again; });
}

std::vector<const CLI::Option*> positionalsOf(const CLI::App& command)
{
  return command.get_options([](const CLI::Option* o) { return o->get_positional(); });
}

bool isFlag(const CLI::Option& option)
{
  return option.get_items_expected_max() == 0;
}

bool isRepeatable(const CLI::Option& option)
{
  return option.get_expected_max() == CLI::detail::expected_max_vector_size;
}

ValueKind valueKindOf(const CLI::Option& option)
{
  const std::string text = option.get_type_name();
  const std::string limits = text.substr(std::min(text.find(':'), text.size()));
  ValueKind kind{text.substr(0, text.find(':')), rangeIn(limits), choicesIn(limits)};
  // That it may come several times is known anyway.
  if (const auto dots = kind.name.find(" ..."); dots != std::string::npos) kind.name.resize(dots);
  if (kind.name != "TEXT" || kind.choices.empty()) return kind;
  kind.name.clear();
  for (const std::string& choice : kind.choices)
    kind.name += (kind.name.empty() ? "" : "|") + choice;
  return kind;
}

Description descriptionOf(const CLI::App& command)
{
  static const std::regex kLabel("^([A-Z][a-z]*:)? +");  // "Example: ", or blanks below it
  Description out;
  std::istringstream in(command.get_description());
  for (std::string line; std::getline(in, line);)
  {
    if (line.rfind("Example:", 0) == 0 || !out.examples.empty())
      out.examples.push_back(std::regex_replace(line, kLabel, ""));
    else
      (out.brief.empty() ? out.brief : out.more.emplace_back()) = line;
  }
  if (const auto end = out.brief.find(".  "); end != std::string::npos)
  {
    out.more.insert(out.more.begin(), out.brief.substr(out.brief.find_first_not_of(' ', end + 1)));
    out.brief.resize(end);
  }
  if (!out.brief.empty() && out.brief.back() == '.') out.brief.pop_back();
  return out;
}
}  // namespace slamot::apps
