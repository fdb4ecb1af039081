#include "settings.h"

#include <slamot/core/Error.h>
#include <slamot/core/FilterRegistry.h>
#include <slamot/dds/DdsOptions.h>
#include <slamot/fusion/TeamOptions.h>
#include <slamot/results/RunPlan.h>

#include <fstream>
#include <functional>
#include <sstream>

namespace slamot::apps
{
namespace
{
/// Has all who read a configuration read it; what those say who could not.
std::vector<std::string> askReaders(core::Config& config)
{
  std::vector<std::string> complaints;
  const auto ask = [&](const std::function<void()>& reader)
  {
    try
    {
      reader();
    }
    catch (const std::exception& e)
    {
      complaints.emplace_back(e.what());
    }
  };
  const core::FilterRegistry& registry = core::FilterRegistry::instance();
  std::vector<std::string> methods = registry.names();
  const bool isEmpty = config.sections().empty();
  if (config.has("team")) ask([&] { (void)fusion::TeamOptions::from(config, 1); });
  if (config.has("dds")) ask([&] { (void)dds::DdsOptions::from(config); });
  if (!isEmpty) ask([&] { methods = {results::planRun(config, {}).method}; });
  core::FilterContext context;
  context.truePose = [](double) { return std::nullopt; };
  for (const std::string& method : methods)
    if (isEmpty || config.has(method) || methods.size() == 1)
      ask([&] { (void)registry.make(method, config, context); });
  return complaints;
}

void addAll(core::Config config, std::map<std::string, std::string>& values)
{
  for (const std::string& name : config.sections())
  {
    core::Params section(config, name);
    for (const std::string& key : section.keys()) values[name + "." + key] = section.text(key);
  }
}

std::vector<std::string> split(const std::string& text, const std::string& between)
{
  std::vector<std::string> out;
  std::size_t from = 0;
  for (std::size_t at = 0; (at = text.find(between, from)) != std::string::npos;
       from = at + between.size())
    out.push_back(text.substr(from, at - from));
  out.push_back(text.substr(from));
  return out;
}
}  // namespace

Settings::Settings(const std::string& config)
{
  std::ifstream file(config);
  std::ostringstream text;
  if (!config.empty() && file) text << file.rdbuf();
  try
  {
    core::Config read = core::Config::parse(text.str(), "config");
    text_ = text.str();
    addAll(read, values_);
    askReaders(read);
    addAll(core::Config::parse(read.effectiveText(), "effective"), values_);
  }
  catch (const core::Error&)
  {
    return;  // half a file is typed yet: nothing is known of it
  }
}

std::vector<std::string> Settings::choices(const std::string& sectionAndKey) const
{
  // Whoever reads the key knows what it may be, and says so when it is something else.
  const auto dot = sectionAndKey.find_last_of('.');
  if (dot == std::string::npos) return {};
  core::Config config = core::Config::parse(text_, "config");
  config.set(sectionAndKey.substr(0, dot), sectionAndKey.substr(dot + 1), "?");
  const std::string about = "] " + sectionAndKey.substr(dot + 1) + ": '?' is not known; set it to ";
  for (const std::string& complaint : askReaders(config))
    if (const auto at = complaint.find(about); at != std::string::npos)
      return split(complaint.substr(at + about.size()), " | ");
  return {};
}
}  // namespace slamot::apps
