#include <slamot/core/Config.h>
#include <slamot/core/Error.h>

#include <algorithm>
#include <fstream>
#include <numeric>
#include <sstream>

namespace slamot::core
{
namespace
{
constexpr std::size_t kLargestIni = 4u << 20;

std::string trim(const std::string& s)
{
  const auto first = s.find_first_not_of(" \t\r\f\v");
  if (first == std::string::npos) return {};
  return s.substr(first, s.find_last_not_of(" \t\r\f\v") - first + 1);
}

std::string lower(std::string s)
{
  std::transform(s.begin(), s.end(), s.begin(), [](unsigned char c) { return std::tolower(c); });
  return s;
}

std::size_t editDistance(const std::string& a, const std::string& b)
{
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i)
  {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j)
    {
      const std::size_t above = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, diagonal + (a[i - 1] != b[j - 1])});
      diagonal = above;
    }
  }
  return row.back();
}

std::string nearest(const std::string& word, const std::vector<std::string>& candidates)
{
  std::string best;
  std::size_t bestDistance = word.size() / 2 + 1;
  for (const std::string& c : candidates)
    if (const std::size_t d = editDistance(word, c); d < bestDistance)
    {
      bestDistance = d;
      best = c;
    }
  return best;
}

std::string suggestion(const std::string& word, const std::vector<std::string>& candidates)
{
  const std::string near = nearest(word, candidates);
  if (!near.empty()) return "did you mean " + near + "?";
  if (candidates.empty()) return "remove it";
  std::string all;
  for (const std::string& c : candidates) all += (all.empty() ? "" : ", ") + c;
  return "known: " + all;
}

[[noreturn]] void fail(const std::string& where, const std::string& what, const std::string& mend)
{
  throw Error(ExitStatus::kConfig, where, what, mend);
}
}  // namespace

Config Config::load(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  if (!file) fail(path, "can't be read", "give the path of an ini file");
  std::string text(kLargestIni + 1, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  if (file.bad() || (text.empty() && !file.eof()))
    fail(path, "can't be read", "give the path of an ini file");
  if (text.size() > kLargestIni) fail(path, "is over 4 MB", "give the path of an ini file");
  return parse(text, path.substr(path.find_last_of('/') + 1));
}

Config Config::parse(const std::string& text, const std::string& name)
{
  Config config;
  config.name_ = name;
  if (text.find('\0') != std::string::npos) fail(name, "is not a text file", "give an ini file");
  std::istringstream in(text);
  std::string line, section;
  for (int number = 1; std::getline(in, line); ++number)
  {
    const std::string where = name + " line " + std::to_string(number);
    line = trim(line.substr(0, line.find("//")));
    if (line.empty() || line[0] == ';' || line[0] == '#') continue;
    if (line[0] == '[')
    {
      if (line.back() != ']' || line.size() < 3) fail(where, "unclosed section", "write [name]");
      section = trim(line.substr(1, line.size() - 2));
      if (section.empty()) fail(where, "section without a name", "write [name]");
      for (const auto& [other, _] : config.sections_)
        if (lower(other) == lower(section))
          fail(where, "section [" + section + "] comes twice", "merge the two");
      config.sections_[section];
      continue;
    }
    const auto equals = line.find('=');
    if (equals == std::string::npos)
      fail(where, "'" + line + "' is no key = value", "mend the line");
    if (section.empty()) fail(where, "a key outside any section", "put it under a [section]");
    const std::string key = trim(line.substr(0, equals));
    if (key.empty()) fail(where, "a value without a key", "write key = value");
    auto& entries = config.sections_[section].entries;
    for (const auto& [other, _] : entries)
      if (lower(other) == lower(key)) fail(where, "key " + key + " comes twice", "remove one");
    entries[key].value = trim(line.substr(equals + 1));
  }
  return config;
}

void Config::set(const std::string& assignment)
{
  const auto equals = assignment.find('=');
  const auto dot = assignment.find_last_of('.', equals);
  if (equals == std::string::npos || dot == std::string::npos || dot == 0 || dot + 1 >= equals)
    fail("--set " + assignment, "wrong form", "write --set Section.key=value");
  set(trim(assignment.substr(0, dot)), trim(assignment.substr(dot + 1, equals - dot - 1)),
      trim(assignment.substr(equals + 1)));
}

void Config::set(const std::string& section, const std::string& key, const std::string& value)
{
  if (value.find_first_of("\n\r") != std::string::npos || value.find("//") != std::string::npos)
    fail("[" + section + "] " + key, "a value can't hold a line break or //", "remove it");
  sections_[section].entries[key].value = value;
}

bool Config::has(const std::string& section, const std::string& key) const
{
  const auto it = sections_.find(section);
  return it != sections_.end() && it->second.entries.count(key) > 0;
}

std::vector<std::string> Config::sections() const
{
  std::vector<std::string> names;
  for (const auto& [name, _] : sections_) names.push_back(name);
  return names;
}

void Config::addMissingSections(const Config& other)
{
  for (const auto& [name, section] : other.sections_) sections_.emplace(name, section);
}

void Config::checkKeys(const std::string& sectionName, const Section& section) const
{
  for (const auto& [key, entry] : section.entries)
    if (!entry.read)
      fail(name_ + " [" + sectionName + "] " + key, "unknown key", suggestion(key, section.asked));
}

void Config::requireAllRead(const std::vector<std::string>& ignored) const
{
  for (const auto& [name, section] : sections_)
  {
    const bool wasRead = std::find(order_.begin(), order_.end(), name) != order_.end();
    if (wasRead)
      checkKeys(name, section);
    else if (std::find(ignored.begin(), ignored.end(), name) == ignored.end())
      fail(name_ + " [" + name + "]", "unknown section", suggestion(name, order_));
  }
}

std::string Config::effectiveText() const
{
  std::string text;
  for (const std::string& name : order_)
  {
    const auto it = sections_.find(name);
    if (it == sections_.end() || it->second.effectiveOrder.empty()) continue;
    const Section& section = it->second;
    text += (text.empty() ? "[" : "\n[") + name + "]\n";
    for (const std::string& key : section.effectiveOrder)
      text += key + " = " + section.effective.at(key) + "\n";
  }
  return text;
}
}  // namespace slamot::core
