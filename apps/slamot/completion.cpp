#include "completion.h"

#include <algorithm>
#include <sstream>

#include "TypedLine.h"
#include "commandLine.h"
#include "settings.h"

namespace slamot::apps
{
namespace
{
void addSettings(const TypedLine& line, Completion& out)
{
  const Settings settings(line.config());
  const auto equals = line.typed().find('=');
  if (equals == std::string::npos)
  {
    for (const auto& [key, value] : settings.values()) out.words.emplace_back(key + "=", value);
    return;
  }
  const std::string key = line.typed().substr(0, equals);
  for (const std::string& choice : settings.choices(key))
    out.words.emplace_back(key + "=" + choice, "");
  const auto inEffect = settings.values().find(key);
  if (out.words.empty() && inEffect != settings.values().end())
    out.words.emplace_back(key + "=" + inEffect->second, "as it is");
}

/// By what a value is called: X.rawlog is a file that ends so, DIR a folder.
void addFiles(const std::string& name, Completion& out)
{
  std::istringstream in(name);
  for (std::string part; std::getline(in, part, '|');)
    if (const auto dot = part.find_last_of('.'); dot != std::string::npos)
      out.files.push_back("*" + part.substr(dot));
  for (const char* any : {"FILE", "PREFIX", "RESULT", "SOURCE"})
    if (name == any) out.files = {"*"};
  out.folders = name == "DIR";
}

void addValues(const TypedLine& line, const CLI::Option& option, Completion& out)
{
  const ValueKind kind = valueKindOf(option);
  for (const std::string& choice : kind.choices) out.words.emplace_back(choice, "");
  if (kind.name == "Section.key=value")
    addSettings(line, out);
  else
    addFiles(kind.name, out);
}

void addOptions(const TypedLine& line, Completion& out)
{
  for (const CLI::App* group : groupsOf(line.command()))
    for (const CLI::Option* option : optionsOf(*group))
      if (line.mayCome(*option, *group))
        for (const std::string& name : option->get_lnames())
          out.words.emplace_back("--" + name, option->get_description());
}
}  // namespace

Completion complete(const CLI::App& program, const std::vector<std::string>& words)
{
  Completion out;
  if (words.empty()) return out;
  const TypedLine line(program, words);
  if (line.valueOf() != nullptr)
    addValues(line, *line.valueOf(), out);
  else if (!line.typed().empty() && line.typed()[0] == '-')
    addOptions(line, out);
  else if (line.isAtCommand())
    for (const CLI::App* command : commandsOf(program))
      out.words.emplace_back(command->get_name(), descriptionOf(*command).brief);
  else if (line.positional() != nullptr)
    addValues(line, *line.positional(), out);
  const auto isOther = [&](const auto& word) { return word.first.rfind(line.typed(), 0) != 0; };
  out.words.erase(std::remove_if(out.words.begin(), out.words.end(), isOther), out.words.end());
  for (auto& word : out.words) word.first.insert(0, line.before());
  return out;
}
}  // namespace slamot::apps
