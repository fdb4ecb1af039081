#include "TypedLine.h"

#include <algorithm>
#include <utility>

#include "commandLine.h"

namespace slamot::apps
{
namespace
{
template <class T>
bool holds(const std::vector<T>& all, const T& one)
{
  return std::find(all.begin(), all.end(), one) != all.end();
}

bool isIni(const std::string& word)
{
  return word.size() > 4 && word.compare(word.size() - 4, 4, ".ini") == 0;
}
}  // namespace

TypedLine::TypedLine(const CLI::App& program, std::vector<std::string> words) : command_(&program)
{
  typed_ = words.back();
  words.pop_back();
  for (const std::string& word : words) take(word);
  const auto equals = typed_.find('=');
  if (valueOf_ != nullptr || typed_.rfind("--", 0) != 0 || equals == std::string::npos) return;
  valueOf_ = option(typed_.substr(0, equals));
  before_ = typed_.substr(0, equals + 1);
  typed_.erase(0, equals + 1);
}

const CLI::Option* TypedLine::positional() const
{
  const auto all = positionalsOf(*command_);
  if (positionals_.size() < all.size()) return all[positionals_.size()];
  return !all.empty() && isRepeatable(*all.back()) ? all.back() : nullptr;
}

bool TypedLine::mayCome(const CLI::Option& option, const CLI::App& group) const
{
  return (isRepeatable(option) || !holds<const CLI::Option*>(used_, &option)) && !isOfOther(group);
}

std::string TypedLine::config() const
{
  const auto found = std::find_if(positionals_.begin(), positionals_.end(), isIni);
  return found == positionals_.end() ? "" : *found;
}

const CLI::Option* TypedLine::option(const std::string& name) const
{
  for (const CLI::App* group : groupsOf(*command_))
    for (const CLI::Option* o : optionsOf(*group))
      if (o->check_name(name)) return o;
  return nullptr;
}

bool TypedLine::isOfOther(const CLI::App& group) const
{
  const auto all = positionalsOf(*command_);
  for (std::size_t i = 0; i < std::min(positionals_.size(), all.size()); ++i)
    if (positionals_[i] != group.get_group() &&
        holds(valueKindOf(*all[i]).choices, group.get_group()))
      return true;
  return false;
}

void TypedLine::take(const std::string& word)
{
  if (std::exchange(valueOf_, nullptr) != nullptr) return;
  if (word.size() > 1 && word[0] == '-')
    takeOption(word);
  else if (hasCommand_)
    positionals_.push_back(word);
  else
    takeCommand(word);
}

void TypedLine::takeOption(const std::string& word)
{
  const auto equals = word.find('=');
  const CLI::Option* const found = option(word.substr(0, equals));
  if (found == nullptr) return;
  used_.push_back(found);
  if (!isFlag(*found) && equals == std::string::npos) valueOf_ = found;
}

void TypedLine::takeCommand(const std::string& word)
{
  static const CLI::App kUnknown;
  const auto all = commandsOf(*command_);
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&](const CLI::App* a) { return a->get_name() == word; });
  command_ = found == all.end() ? &kUnknown : *found;
  hasCommand_ = true;
}
}  // namespace slamot::apps
