#pragma once

#include <slamot/core/Params.h>
#include <slamot/study/StudySpec.h>

#include <filesystem>

namespace slamot::study
{
/// Takes `Section.key` apart.  \throws core::Error (kConfig) if it is no such thing.
std::pair<std::string, std::string> splitKey(core::Params& p, const std::string& key,
                                             const std::string& text);

/// Reads the file that a key names, relative to `folder`.  \throws core::Error (kConfig).
ConfigFile readFile(core::Params& p, const std::string& key, const std::filesystem::path& folder);

/// Names of metrics.  \throws core::Error (kConfig) on one that there is not.
std::vector<std::string> readMetrics(core::Params& p, const std::string& key,
                                     const std::optional<std::string>& otherwise = {});

Method readMethod(core::Config& study, const std::string& name,
                  const std::filesystem::path& folder);
/// \throws core::Error (kConfig) if neither the scenario nor a method has a section that it varies.
Axis readAxis(core::Config& study, const std::string& name, const StudySpec& spec);
/// The tables that [study] tables names; without it, one of the two mean errors.
std::vector<TableSpec> readTables(core::Config& study, core::Params& p, const StudySpec& spec);
/// All [plot.<name>] and all [published.<name>].
std::vector<PlotSpec> readPlots(core::Config& study, const StudySpec& spec);
std::vector<Published> readPublished(core::Config& study);

/// The place of a name in a list of things that have one.
template <class List>
std::optional<std::size_t> placeOf(const List& list, const std::string& name)
{
  for (std::size_t i = 0; i < list.size(); ++i)
    if (list[i].name == name) return i;
  return std::nullopt;
}
}  // namespace slamot::study
