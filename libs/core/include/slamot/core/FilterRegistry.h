#pragma once

/// \file
/// The registry of filters, and SLAMOT_REGISTER_FILTER for plugins.

#include <slamot/core/Filter.h>
#include <slamot/core/Params.h>

#include <functional>
#include <map>
#include <memory>
#include <set>

namespace slamot::core
{
/// The filters that can be made by name: built-in ones added by slamot::filters::registerAll(),
/// others by SLAMOT_REGISTER_FILTER in a plugin.
class FilterRegistry
{
 public:
  /// Makes a filter from its section of the config. \throws Error (kConfig) by Params' readers.
  using Factory = std::function<std::unique_ptr<Filter>(Params&, const FilterContext&)>;

  /// The one of this process, for the program and every plugin that it loads.
  static FilterRegistry& instance();

  /// A name that comes twice is an error of make(): plugins add while they are loaded, where an
  /// exception would end the program.
  void add(const std::string& name, Factory factory);
  /// Whether make() would find it.
  [[nodiscard]] bool has(const std::string& name) const { return factories_.count(name) > 0; }
  /// In alphabetical order.
  [[nodiscard]] std::vector<std::string> names() const;

  /// Makes the filter `name` with the config's section of that name.
  /// \throws Error (kConfig) if there is no such filter, two have the name, or its parameters are
  /// wrong.
  [[nodiscard]] std::unique_ptr<Filter> make(const std::string& name, Config& config,
                                             const FilterContext& context) const;

 private:
  std::map<std::string, Factory> factories_;
  std::set<std::string> twice_;
};

/// The filter that a config is for: `method` of [run], else its one section named after a filter.
/// \throws Error (kConfig) if that leaves none or several.
[[nodiscard]] std::string methodOf(Config& config);
}  // namespace slamot::core

/// In a plugin's .cpp, at global scope: `class` is made by (Params&, const FilterContext&).
#define SLAMOT_REGISTER_FILTER(name, class)                                         \
  namespace                                                                         \
  {                                                                                 \
  const bool slamotRegistered = []                                                  \
  {                                                                                 \
    ::slamot::core::FilterRegistry::instance().add(                                 \
        name, [](::slamot::core::Params& p, const ::slamot::core::FilterContext& c) \
        { return std::make_unique<class>(p, c); });                                 \
    return true;                                                                    \
  }();                                                                              \
  }
