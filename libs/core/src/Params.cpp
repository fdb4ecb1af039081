#include <slamot/core/Error.h>
#include <slamot/core/Params.h>
#include <slamot/math/geometry.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

namespace slamot::core
{
namespace
{
constexpr double kInf = std::numeric_limits<double>::infinity();

std::string format(double v)
{
  char text[40];
  const auto end = std::to_chars(text, text + sizeof text, v).ptr;  // shortest that reads back
  return {text, end};
}

// from_chars: strict, whole, and the same in every locale.
std::optional<double> parseNumber(std::string s)
{
  if (s.size() > 1 && s[0] == '+' && s[1] != '-') s.erase(0, 1);
  double v = 0;
  const auto [end, error] = std::from_chars(s.data(), s.data() + s.size(), v);
  if (error != std::errc{} || end != s.data() + s.size() || !std::isfinite(v)) return std::nullopt;
  return v;
}

std::string range(double lo, double hi, bool open)
{
  if (lo == -kInf && hi == kInf) return "a number";
  if (hi == kInf) return std::string("a number ") + (open ? "> " : ">= ") + format(lo);
  return "a number in " + std::string(open ? "(" : "[") + format(lo) + ", " + format(hi) +
         (open ? ")" : "]");
}

bool inDegrees(const std::string& key)
{
  const auto at = key.find("_deg");
  return at != std::string::npos &&
         (at + 4 == key.size() || key[at + 4] == '_' || key[at + 4] == 'p');
}

/// The parts between commas, trimmed; a part may be empty.
std::vector<std::string> split(const std::string& text)
{
  std::vector<std::string> parts;
  std::istringstream in(text + ',');
  for (std::string part; std::getline(in, part, ',');)
  {
    const auto first = part.find_first_not_of(" \t");
    const auto end = part.find_last_not_of(" \t") + 1;
    parts.push_back(first == std::string::npos ? "" : part.substr(first, end - first));
  }
  return parts;
}

template <class T>
void remember(std::vector<T>& list, const T& value)
{
  if (std::find(list.begin(), list.end(), value) == list.end()) list.push_back(value);
}
}  // namespace

Params::Params(Config& config, std::string section) : config_(&config), section_(std::move(section))
{
  config_->sections_[section_];
  remember(config_->order_, section_);
}

void Params::fail(const std::string& key, const std::string& what, const std::string& mend) const
{
  throw Error(ExitStatus::kConfig, config_->name() + " [" + section_ + "] " + key, what, mend);
}

std::string Params::read(const std::string& key, const std::optional<std::string>& otherwise,
                         const std::string& allowed)
{
  auto& section = config_->sections_[section_];
  remember(section.asked, key);
  const auto it = section.entries.find(key);
  if (it == section.entries.end() && !otherwise) fail(key, "missing", "set it to " + allowed);
  std::string value = it == section.entries.end() ? *otherwise : it->second.value;
  if (it != section.entries.end()) it->second.read = true;
  if (!section.effective.count(key)) section.effectiveOrder.push_back(key);
  section.effective[key] = value;
  return value;
}

double Params::readNumber(const std::string& key, double lo, double hi, bool open,
                          std::optional<double> otherwise)
{
  const double unit = inDegrees(key) ? math::kPi / 180.0 : 1.0;
  const std::string allowed = range(lo, hi, open);
  std::optional<std::string> text;
  if (otherwise) text = format(*otherwise / unit);
  const std::string value = read(key, text, allowed);
  const auto v = parseNumber(value);
  if (!v) fail(key, "'" + value + "' is no number", "set it to " + allowed);
  if (*v < lo || *v > hi || (open && (*v == lo || *v == hi)))
    fail(key, value + " is out of range", "set it to " + allowed);
  return *v * unit;
}

double Params::number(const std::string& key, std::optional<double> otherwise)
{
  return readNumber(key, -kInf, kInf, false, otherwise);
}
double Params::positive(const std::string& key, std::optional<double> otherwise)
{
  return readNumber(key, 0, kInf, true, otherwise);
}
double Params::nonNegative(const std::string& key, std::optional<double> otherwise)
{
  return readNumber(key, 0, kInf, false, otherwise);
}
double Params::probability(const std::string& key, std::optional<double> otherwise)
{
  return readNumber(key, 0, 1, true, otherwise);
}
double Params::inRange(const std::string& key, double lo, double hi,
                       std::optional<double> otherwise)
{
  return readNumber(key, lo, hi, false, otherwise);
}

std::optional<double> Params::optionalNumber(const std::string& key, double lo)
{
  if (has(key)) return readNumber(key, lo, kInf, false, {});
  remember(config_->sections_[section_].asked, key);
  return std::nullopt;
}

int Params::integer(const std::string& key, int lo, int hi, std::optional<int> otherwise)
{
  const std::string allowed =
      "a whole number from " + std::to_string(lo) + " to " + std::to_string(hi);
  std::optional<std::string> text;
  if (otherwise) text = std::to_string(*otherwise);
  const std::string value = read(key, text, allowed);
  int v = 0;
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), v);
  if (error == std::errc::invalid_argument || end != value.data() + value.size())
    fail(key, "'" + value + "' is no whole number", "set it to " + allowed);
  if (error != std::errc{} || v < lo || v > hi)
    fail(key, value + " is out of range", "set it to " + allowed);
  return v;
}

bool Params::flag(const std::string& key, std::optional<bool> otherwise)
{
  std::optional<std::string> text;
  if (otherwise) text = *otherwise ? "true" : "false";
  return choice(key, {"true", "false"}, text) == "true";
}

std::string Params::text(const std::string& key, std::optional<std::string> otherwise)
{
  return read(key, otherwise, "a text");
}

std::string Params::choice(const std::string& key, const std::vector<std::string>& choices,
                           std::optional<std::string> otherwise)
{
  std::string allowed;
  for (const std::string& c : choices) allowed += (allowed.empty() ? "" : " | ") + c;
  const std::string value = read(key, otherwise, allowed);
  if (std::find(choices.begin(), choices.end(), value) == choices.end())
    fail(key, "'" + value + "' is not known", "set it to " + allowed);
  return value;
}

std::vector<std::string> Params::list(const std::string& key, std::optional<std::string> otherwise)
{
  const auto parts = split(read(key, otherwise, "a comma-separated list"));
  // Left out in silence, an empty part would shift the values after it.
  if (std::find(parts.begin(), parts.end(), "") != parts.end())
    fail(key, "has an empty part", "give values with single commas between");
  return parts;
}

std::vector<double> Params::numbers(const std::string& key, std::optional<std::string> otherwise)
{
  const double unit = inDegrees(key) ? math::kPi / 180.0 : 1.0;
  std::vector<double> values;
  for (const std::string& part : list(key, std::move(otherwise)))
  {
    const auto v = parseNumber(part);
    if (!v) fail(key, "'" + part + "' is no number", "give numbers with commas between");
    values.push_back(*v * unit);
  }
  return values;
}

void Params::allowUnused(const std::vector<std::string>& keys)
{
  auto& section = config_->sections_[section_];
  for (const std::string& key : keys)
  {
    remember(section.asked, key);
    const auto it = section.entries.find(key);
    if (it != section.entries.end()) it->second.read = true;
  }
}

std::vector<std::string> Params::keys() const
{
  std::vector<std::string> names;
  for (const auto& [key, _] : config_->sections_.at(section_).entries) names.push_back(key);
  return names;
}
}  // namespace slamot::core
