#include <slamot/core/Error.h>
#include <slamot/core/FilterRegistry.h>

namespace slamot::core
{
FilterRegistry& FilterRegistry::instance()
{
  static FilterRegistry registry;
  return registry;
}

void FilterRegistry::add(const std::string& name, Factory factory)
{
  if (!factories_.emplace(name, std::move(factory)).second) twice_.insert(name);
}

std::vector<std::string> FilterRegistry::names() const
{
  std::vector<std::string> out;
  for (const auto& [name, _] : factories_) out.push_back(name);
  return out;
}

std::unique_ptr<Filter> FilterRegistry::make(const std::string& name, Config& config,
                                             const FilterContext& context) const
{
  const auto it = factories_.find(name);
  if (it == factories_.end())
  {
    std::string known;
    for (const auto& [n, _] : factories_) known += (known.empty() ? "" : ", ") + n;
    throw Error(ExitStatus::kConfig, config.name(), "filter '" + name + "' is unknown",
                "known: " + known + "; load others with --plugin");
  }
  if (twice_.count(name))
    throw Error(ExitStatus::kConfig, "filter " + name, "is registered twice",
                "give the plugin's filter another name");
  Params params(config, name);
  return it->second(params, context);
}

std::string methodOf(Config& config)
{
  const FilterRegistry& registry = FilterRegistry::instance();
  if (config.has("run", "method")) return Params(config, "run").choice("method", registry.names());
  std::string method;
  for (const std::string& section : config.sections())
    if (registry.has(section))
    {
      if (!method.empty())
        throw Error(ExitStatus::kConfig, config.name(),
                    "has sections for " + method + " and " + section,
                    "name the one to run: [run] method = " + method);
      method = section;
    }
  if (method.empty())
    throw Error(ExitStatus::kConfig, config.name(), "names no filter",
                "add [run] method = NAME, or a section named after a filter");
  config.set("run", "method", method);
  return Params(config, "run").choice("method", registry.names());
}
}  // namespace slamot::core
