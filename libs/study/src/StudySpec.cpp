#include <slamot/core/Error.h>
#include <slamot/study/StudySpec.h>

#include <set>

#include "specReading.h"

namespace slamot::study
{
namespace
{
namespace fs = std::filesystem;

constexpr int kMostSeeds = 1'000'000;
constexpr int kMostTimeBins = 1000;

std::string trimmed(const std::string& text)
{
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// Sections that lists of [study] choose from: what they leave out is not looked at.
std::vector<std::string> choosable(const core::Config& study)
{
  std::vector<std::string> out;
  for (const std::string& section : study.sections())
    for (const char* kind : {"method.", "vary.", "table."})
      if (section.rfind(kind, 0) == 0) out.push_back(section);
  return out;
}

void readData(core::Config& study, core::Params& p, const fs::path& folder, StudySpec& spec)
{
  spec.simulated = p.has("scenario");
  if (spec.simulated == p.has("rawlogs"))
    p.fail("scenario", spec.simulated ? "is given beside rawlogs" : "missing",
           "give either scenario or rawlogs");
  if (spec.simulated)
  {
    spec.scenario = readFile(p, "scenario", folder);
    core::Params overrides(study, "scenario");
    for (const std::string& key : overrides.keys())
    {
      splitKey(overrides, key, key);
      spec.scenario.values.emplace_back(key, overrides.text(key));
    }
    return;
  }
  for (const std::string& path : p.list("rawlogs"))
  {
    if (!fs::is_regular_file(folder / path))
      throw core::Error(core::ExitStatus::kUnreadable, (folder / path).string(), "can't be read",
                        "rawlogs are relative to the study's file");
    spec.rawlogs.push_back((folder / path).string());
  }
}

void readMethods(core::Config& study, core::Params& p, const fs::path& folder, StudySpec& spec)
{
  std::set<std::string> names;
  for (const std::string& name : p.list("methods"))
  {
    if (!names.insert(name).second) p.fail("methods", name + " comes twice", "remove one");
    spec.methods.push_back(readMethod(study, name, folder));
  }
  spec.reference = p.text("reference", "none");
  if (spec.reference == "none") spec.reference.clear();
  if (!spec.reference.empty() && names.count(spec.reference) == 0)
    p.fail("reference", "'" + spec.reference + "' is none of the methods", "name one, or none");
}

void readAxes(core::Config& study, core::Params& p, StudySpec& spec)
{
  const auto names = p.list("vary", "none");
  if (names == std::vector<std::string>{"none"}) return;
  std::set<std::string> seen;
  for (const std::string& name : names)
  {
    if (!seen.insert(name).second) p.fail("vary", name + " comes twice", "remove one");
    spec.axes.push_back(readAxis(study, name, spec));
  }
}

/// The study as an ini text that repeats it from a folder where saveSpec() has put its files.
std::string effectiveText(core::Config& study, const StudySpec& spec)
{
  if (spec.simulated)
    study.set("study", "scenario", "config/scenario.ini");
  else
  {
    std::string paths;
    for (const std::string& path : spec.rawlogs)
      paths += (paths.empty() ? "" : ", ") + fs::absolute(path).lexically_normal().string();
    study.set("study", "rawlogs", paths);
  }
  core::Params(study, "study").text(spec.simulated ? "scenario" : "rawlogs");
  for (const Method& m : spec.methods)
  {
    const std::string section = "method." + m.name;
    study.set(section, "config", "config/" + m.name + ".ini");
    core::Params(study, section).text("config");
  }
  return study.effectiveText();
}
}  // namespace

void assign(core::Config& config, const std::string& assignment,
            const std::vector<std::string>& more)
{
  std::string section;
  auto sections = config.sections();
  sections.insert(sections.end(), more.begin(), more.end());
  for (const std::string& s : sections)
    if (assignment.rfind(s + ".", 0) == 0 && s.size() > section.size()) section = s;
  const auto equals = assignment.find('=');
  if (section.empty() || equals == std::string::npos || equals <= section.size() + 1)
    return config.set(assignment);
  config.set(section, trimmed(assignment.substr(section.size() + 1, equals - section.size() - 1)),
             trimmed(assignment.substr(equals + 1)));
}

core::Config ConfigFile::config() const
{
  core::Config out = core::Config::parse(text, name);
  for (const auto& [key, value] : values)
  {
    const auto dot = key.find_last_of('.');
    out.set(key.substr(0, dot), key.substr(dot + 1), value);
  }
  return out;
}

StudySpec StudySpec::load(const std::string& path, const std::vector<std::string>& set)
{
  core::Config study = core::Config::load(path);
  const auto unused = choosable(study);
  for (const std::string& assignment : set) assign(study, assignment, {"scenario"});
  const fs::path folder = fs::path(path).parent_path();
  core::Params p(study, "study");
  StudySpec spec;
  spec.name = study.name();
  spec.title = p.text("title", study.name());
  spec.note = p.text("note", "");
  readData(study, p, folder, spec);
  readMethods(study, p, folder, spec);
  readAxes(study, p, spec);
  spec.seeds = p.integer("seeds", 1, kMostSeeds);
  spec.firstSeed =
      static_cast<std::uint64_t>(p.integer("first_seed", 0, std::numeric_limits<int>::max(), 1));
  spec.align = p.choice("align", {"auto", "none", "first-pose", "rigid"}, "auto");
  spec.landmarkCutoff = p.positive("landmark_cutoff_m", spec.landmarkCutoff);
  spec.gospaCutoff = p.positive("gospa_cutoff_m", spec.gospaCutoff);
  spec.bound = p.flag("bound", true);
  spec.timeBins = p.integer("time_bins", 0, kMostTimeBins, 0);
  spec.tables = readTables(study, p, spec);
  spec.plots = readPlots(study, spec);
  spec.published = readPublished(study);
  study.requireAllRead(unused);
  spec.effective = effectiveText(study, spec);
  return spec;
}
}  // namespace slamot::study
