#include <slamot/study/Plan.h>

#include <slamot/core/Error.h>
#include <slamot/core/version.h>
#include <slamot/study/Metrics.h>
#include <slamot/study/Trial.h>

#include <filesystem>
#include <map>
#include <set>

#include "hash.h"

namespace slamot::study
{
namespace
{
constexpr std::size_t kMostCells = 10'000;

std::vector<Cell> cellsOf(const StudySpec& spec)
{
  std::vector<Cell> cells;
  for (std::size_t log = 0; log < std::max<std::size_t>(spec.rawlogs.size(), 1); ++log)
    cells.push_back({log, {}});
  for (const Axis& axis : spec.axes)
  {
    std::vector<Cell> longer;
    if (cells.size() * axis.values.size() > kMostCells)
      throw core::Error(core::ExitStatus::kLimit, spec.name,
                        "varies over more than " + std::to_string(kMostCells) + " combinations",
                        "give fewer values");
    for (const Cell& cell : cells)
      for (std::size_t v = 0; v < axis.values.size(); ++v)
      {
        longer.push_back(cell);
        longer.back().values.push_back(v);
      }
    cells = std::move(longer);
  }
  return cells;
}

std::string fileName(std::string text)
{
  for (char& c : text)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != '.') c = '_';
  return text;
}

// The metrics are part of the hash: records without a new one are made anew.
std::string recordFormat()
{
  std::string text = std::string("slamot ") + kVersion;
  for (const Metric& m : metrics()) text += std::string(" ") + m.name;
  return text;
}
}  // namespace

Plan::Plan(StudySpec study) : spec(std::move(study)), cells(cellsOf(spec))
{
  std::map<std::pair<std::size_t, std::string>, std::size_t> known;  // by method and hash
  std::set<std::string> folders;
  for (std::size_t c = 0; c < cells.size(); ++c)
  {
    groupOf.emplace_back();
    for (std::size_t m = 0; m < spec.methods.size(); ++m)
    {
      const Trial trial = openTrial(spec, cells[c], spec.methods[m], spec.firstSeed);
      const std::string hash = hashOf(recordFormat() + trial.effective);
      const auto [it, isNew] = known.emplace(std::make_pair(m, hash), groups.size());
      groupOf.back().push_back(it->second);
      if (!isNew) continue;
      std::string folder = spec.methods[m].name;
      const auto names = cellNames(), values = cellValues(cells[c]);
      for (std::size_t i = 0; i < names.size(); ++i)
        folder += "_" + fileName(names[i] + "-" + values[i]);
      while (!folders.insert(folder).second) folder += "_";
      groups.push_back({c, m, hash, folder});
    }
  }
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (int s = 0; s < spec.seeds; ++s)
      runs.push_back({g, spec.firstSeed + static_cast<std::uint64_t>(s)});
}

std::string Plan::recordPath(const Run& run) const
{
  return "runs/" + groups[run.group].folder + "/" + std::to_string(run.seed) + ".json";
}

std::vector<std::string> Plan::cellValues(const Cell& cell) const
{
  std::vector<std::string> out;
  if (spec.rawlogs.size() > 1)
    out.push_back(std::filesystem::path(spec.rawlogs[cell.rawlog]).stem().string());
  for (std::size_t a = 0; a < spec.axes.size(); ++a)
    out.push_back(spec.axes[a].values[cell.values[a]]);
  return out;
}

std::vector<std::string> Plan::cellLabels() const
{
  std::vector<std::string> out;
  if (spec.rawlogs.size() > 1) out.emplace_back("dataset");
  for (const Axis& axis : spec.axes) out.push_back(axis.label);
  return out;
}

std::vector<std::string> Plan::cellNames() const
{
  std::vector<std::string> out;
  if (spec.rawlogs.size() > 1) out.emplace_back("dataset");
  for (const Axis& axis : spec.axes) out.push_back(axis.name);
  return out;
}
}  // namespace slamot::study
