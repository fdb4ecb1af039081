#include "specReading.h"

#include <slamot/core/Error.h>
#include <slamot/study/ErrorCurves.h>
#include <slamot/study/Metrics.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <sstream>

namespace slamot::study
{
namespace
{
constexpr std::streamoff kLargestFile = 4 << 20;  // as core::Config

// A name becomes part of file names.
void checkName(core::Params& p, const std::string& key, const std::string& name)
{
  const auto plain = [](unsigned char c) { return std::isalnum(c) || c == '-' || c == '_'; };
  if (!std::all_of(name.begin(), name.end(), plain))
    p.fail(key, "'" + name + "' can't be a name", "use letters, digits, - and _");
}

bool hasSection(const ConfigFile& file, const std::string& section)
{
  return file.config().has(section);
}

bool isNumber(const std::string& text)
{
  double v = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), v);
  return error == std::errc{} && end == text.data() + text.size();
}
}  // namespace

std::pair<std::string, std::string> splitKey(core::Params& p, const std::string& key,
                                             const std::string& text)
{
  const auto dot = text.find_last_of('.');
  if (dot == std::string::npos || dot == 0 || dot + 1 == text.size())
    p.fail(key, "'" + text + "' is no Section.key", "write one, as world.landmarks");
  return {text.substr(0, dot), text.substr(dot + 1)};
}

ConfigFile readFile(core::Params& p, const std::string& key, const std::filesystem::path& folder)
{
  const std::filesystem::path path = folder / p.text(key);
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file || std::filesystem::is_directory(path))
    p.fail(key, path.string() + " can't be read", "paths are relative to the study's file");
  if (file.tellg() > kLargestFile) p.fail(key, path.string() + " is over 4 MB", "give an ini file");
  std::ostringstream text;
  file.seekg(0);
  text << file.rdbuf();
  return {path.filename().string(), text.str(), {}};
}

std::vector<std::string> readMetrics(core::Params& p, const std::string& key,
                                     const std::optional<std::string>& otherwise)
{
  const auto names = p.list(key, otherwise);
  for (const std::string& name : names)
  {
    if (metricByName(name)) continue;
    std::string known;
    for (const Metric& m : metrics()) known += (known.empty() ? "" : ", ") + std::string(m.name);
    p.fail(key, "'" + name + "' is no metric", "known: " + known);
  }
  return names;
}

Method readMethod(core::Config& study, const std::string& name, const std::filesystem::path& folder)
{
  const std::string section = "method." + name;
  if (!study.has(section))
    core::Params(study, "study").fail("methods", "there is no [" + section + "]", "add it");
  core::Params p(study, section);
  checkName(p, "", name);
  Method out{name, p.text("label", name), readFile(p, "config", folder)};
  for (const std::string& key : p.keys())
  {
    if (key.find('.') == std::string::npos) continue;
    splitKey(p, key, key);
    out.file.values.emplace_back(key, p.text(key));
  }
  return out;
}

namespace
{
/// A value's words, one for each key; or the value for all keys.
std::vector<std::string> settingsOf(core::Params& p, const std::string& value, std::size_t keys,
                                    bool wordByWord)
{
  if (!wordByWord) return std::vector<std::string>(keys, value);
  std::istringstream in(value);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  if (words.size() != keys)
    p.fail("values", "'" + value + "' has not one word for each of the keys",
           "write " + std::to_string(keys) + " of them, between blanks");
  return words;
}

void readValues(core::Params& p, Axis& axis)
{
  axis.values = p.list("values");
  const auto hasBlank = [](const std::string& v) { return v.find_first_of(" \t") < v.size(); };
  const bool wordByWord =
      axis.keys.size() > 1 && std::any_of(axis.values.begin(), axis.values.end(), hasBlank);
  for (const std::string& value : axis.values)
    axis.settings.push_back(settingsOf(p, value, axis.keys.size(), wordByWord));
  if (!p.has("value_labels")) return;
  const auto labels = p.list("value_labels");
  if (labels.size() != axis.values.size())
    p.fail("value_labels", "are not as many as values", "write one for each");
  axis.values = labels;
}
}  // namespace

Axis readAxis(core::Config& study, const std::string& name, const StudySpec& spec)
{
  const std::string section = "vary." + name;
  if (!study.has(section))
    core::Params(study, "study").fail("vary", "there is no [" + section + "]", "add it");
  core::Params p(study, section);
  checkName(p, "", name);
  Axis out{name, p.text("label", name), p.list("keys"), {}, {}};
  readValues(p, out);
  for (const std::string& key : out.keys)
  {
    const std::string varied = splitKey(p, "keys", key).first;
    const bool known = (spec.simulated && hasSection(spec.scenario, varied)) ||
                       std::any_of(spec.methods.begin(), spec.methods.end(),
                                   [&](const Method& m) { return hasSection(m.file, varied); });
    if (!known)
      p.fail("keys", "neither the scenario nor a method has a section [" + varied + "]",
             "name a section that one has");
  }
  return out;
}

namespace
{
/// Of the methods that there are, whether the study runs them or not.
std::vector<std::string> readShownMethods(const core::Config& study, core::Params& p)
{
  auto names = p.list("methods");
  for (const std::string& name : names)
    if (!study.has("method." + name))
      p.fail("methods", "there is no [method." + name + "]", "name those of this study");
  return names;
}
}  // namespace

std::vector<TableSpec> readTables(core::Config& study, core::Params& p, const StudySpec& spec)
{
  if (!p.has("tables")) return {{"errors", "", {"robot_mean_m", "target_mean_m"}, "", {}}};
  std::vector<TableSpec> out;
  for (const std::string& name : p.list("tables"))
  {
    if (!study.has("table." + name)) p.fail("tables", "there is no [table." + name + "]", "add it");
    core::Params t(study, "table." + name);
    TableSpec table{name, t.text("title", ""), readMetrics(t, "columns"), "", {}};
    if (t.has("methods")) table.methods = readShownMethods(study, t);
    if (t.flag("ratios", false))
    {
      if (spec.reference.empty() && !t.has("reference"))
        t.fail("ratios", "there is no method to compare with", "set reference, here or in [study]");
      table.reference = t.text("reference", spec.reference);
      if (!placeOf(spec.methods, table.reference))
        t.fail("reference", "'" + table.reference + "' is none of the methods", "name one");
    }
    out.push_back(table);
  }
  return out;
}

namespace
{
/// Names of curves.  \throws core::Error (kConfig) on one that there can't be.
std::vector<std::string> readCurves(core::Params& p)
{
  const auto names = p.list("y", "robot_position_m, target_position_m");
  for (const std::string& name : names)
    if (!isCurveName(name))
      p.fail("y", "'" + name + "' is no error over time",
             "known: robot_position_m, robot_heading_rad, target_position_m, target_heading_rad, "
             "and of one robot of a team robot<number>_position_m, robot<number>_heading_rad");
  return names;
}

/// Keys that are axes, of the cells that a plot is to show.
void readFixed(core::Params& p, const std::vector<Axis>& axes, const std::string& x, PlotSpec& plot)
{
  for (std::size_t a = 0; a < axes.size(); ++a)
  {
    const Axis& axis = axes[a];
    if (axis.name == x || !p.has(axis.name)) continue;
    const std::string value = p.text(axis.name);
    const auto it = std::find(axis.values.begin(), axis.values.end(), value);
    if (it == axis.values.end())
      p.fail(axis.name, "'" + value + "' is none of its values", "write one as tables show it");
    plot.fixed[a] = static_cast<std::size_t>(it - axis.values.begin());
  }
}

void readPlotOverTime(core::Params& p, const StudySpec& spec, PlotSpec& plot)
{
  plot.overTime = true;
  if (spec.timeBins == 0)
    p.fail("x", "the study keeps no errors over time", "set [study] time_bins, as to 60");
  plot.metrics = readCurves(p);
}

void readPlotOverAxis(core::Params& p, const std::vector<Axis>& axes, const std::string& x,
                      PlotSpec& plot)
{
  const auto axis = placeOf(axes, x);
  if (!axis) p.fail("x", "'" + x + "' is not varied", "name one of [study] vary");
  plot.axis = *axis;
  const auto& values = axes[*axis].values;
  if (!std::all_of(values.begin(), values.end(), isNumber))
    p.fail("x", "the values of " + x + " are no numbers", "plot over another");
  plot.metrics = readMetrics(p, "y", "robot_mean_m, target_mean_m");
  plot.logX = p.flag("log_x", false);
}
}  // namespace

std::vector<PlotSpec> readPlots(core::Config& study, const StudySpec& spec)
{
  std::vector<PlotSpec> out;
  for (const std::string& section : study.sections())
  {
    if (section.rfind("plot.", 0) != 0) continue;
    core::Params p(study, section);
    PlotSpec plot;
    plot.name = section.substr(5);
    checkName(p, "", plot.name);
    plot.title = p.text("title", "");
    if (spec.axes.empty() && !p.has("x"))
      p.fail("x", "nothing is varied", "remove the plot, or set [study] vary, or x to time");
    const std::string x = p.text("x", spec.axes.empty() ? "" : spec.axes.front().name);
    readFixed(p, spec.axes, x, plot);
    plot.logY = p.flag("log_y", false);
    if (p.has("methods")) plot.methods = readShownMethods(study, p);
    if (x == "time" && !placeOf(spec.axes, x))
      readPlotOverTime(p, spec, plot);
    else
      readPlotOverAxis(p, spec.axes, x, plot);
    out.push_back(plot);
  }
  return out;
}

namespace
{
/// Of axes that [study] vary leaves out, too.
std::vector<std::string> axisNames(const core::Config& study)
{
  std::vector<std::string> out;
  for (const std::string& section : study.sections())
    if (section.rfind("vary.", 0) == 0) out.push_back(section.substr(5));
  return out;
}
}  // namespace

std::vector<Published> readPublished(core::Config& study)
{
  std::vector<Published> out;
  for (const std::string& section : study.sections())
  {
    if (section.rfind("published.", 0) != 0) continue;
    core::Params p(study, section);
    Published row;
    row.label = p.text("label", section.substr(10));
    row.method = p.text("method", "");
    if (!row.method.empty() && !study.has("method." + row.method))
      p.fail("method", "there is no [method." + row.method + "]", "name one, or remove it");
    for (const std::string& axis : axisNames(study))
      if (p.has(axis)) row.byAxis[axis] = p.text(axis);
    if (row.method.empty() && !row.byAxis.empty())
      p.fail("method", "missing", "tell which method's row in that cell it stands under");
    for (const Metric& m : metrics())
      if (p.has(m.name)) row.byMetric[m.name] = p.text(m.name);
    out.push_back(row);
  }
  return out;
}
}  // namespace slamot::study
