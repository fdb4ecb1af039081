#include <slamot/study/results.h>

#include <slamot/core/Error.h>
#include <slamot/results/Gnuplot.h>
#include <slamot/results/TextFile.h>
#include <slamot/study/tables.h>

#include <filesystem>

namespace slamot::study
{
namespace
{
void makeFolder(const std::string& folder)
{
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw core::Error(core::ExitStatus::kUnreadable, folder, "can't be made: " + error.message(),
                      "write elsewhere");
}
}  // namespace

void saveTables(const std::string& folder, const Plan& plan, const Outcome& outcome)
{
  makeFolder(folder);
  results::writeWhole(folder + "/table.md", tableMarkdown(plan, outcome));
  results::writeWhole(folder + "/table.csv", tableCsv(plan, outcome));
  results::writeWhole(folder + "/runs.csv", runsCsv(plan, outcome));
  results::writeWhole(folder + "/timing.csv", timingCsv(plan, outcome));
}

void saveResults(const std::string& folder, const Plan& plan, const Outcome& outcome)
{
  saveTables(folder, plan, outcome);
  for (const PlotSpec& plot : plan.spec.plots)
  {
    const results::Figure figure = figureOf(plan, outcome, plot);
    results::saveFigure(folder + "/" + plot.name + ".svg", figure);
    results::saveFigure(folder + "/" + plot.name + ".png", figure);
  }
}

void saveSpec(const std::string& folder, const StudySpec& spec)
{
  makeFolder(folder + "/config");
  if (spec.simulated) results::writeWhole(folder + "/config/scenario.ini", spec.scenario.text);
  for (const Method& m : spec.methods)
    results::writeWhole(folder + "/config/" + m.name + ".ini", m.file.text);
  results::writeWhole(folder + "/study.ini", spec.effective);
}
}  // namespace slamot::study
