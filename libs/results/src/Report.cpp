#include <slamot/results/Report.h>

#include <slamot/core/version.h>
#include <slamot/results/HtmlPage.h>
#include <slamot/results/TextFile.h>
#include <slamot/results/hints.h>
#include <slamot/results/keyNumbers.h>

#include <filesystem>

namespace slamot::results
{
namespace
{
/// How the map was laid over the truth, where it was.
std::string alignmentNote(eval::Align align)
{
  if (align == eval::Align::kFirstPose)
    return " The map was moved so that its first pose agrees with the truth's.";
  if (align == eval::Align::kRigid)
    return " The map was moved and turned as a whole to fit the true path best.";
  return {};
}

void addNumbers(HtmlPage& page, const RunView& run)
{
  page.heading("Key numbers");
  const Table errors = errorTable(run);
  if (errors.rows.empty())
    page.paragraph("No ground truth goes with this log, so there are no errors to tell.");
  else
  {
    page.table(errors);
    page.paragraph(
        "NEES (3) is the mean of the squared errors of x, y and heading, normalised by the "
        "filter's "
        "own covariance: 3 if the filter is as sure as it should be, more if it is too sure; NEES "
        "(2) is that of x and y, and should be 2." +
        alignmentNote(run.evaluation.align));
  }
  page.table(factTable(run));
}

void addErrors(HtmlPage& page, const RunView& run)
{
  const std::string how =
      ": estimate less truth. The grey band is what the filter believes, three "
      "standard deviations to each side.";
  if (const auto figure = robotErrorFigure(run)) page.figure("Errors of the robot" + how, *figure);
  const auto groups = targetGroups(run.record, run.evaluation);
  for (std::size_t g = 0; g < groups.size(); ++g)
    if (const auto figure = targetErrorFigure(run, groups[g], inkOf(g)))
      page.figure("Errors of " + groups[g].name + how, *figure);
}

void addScans(HtmlPage& page, const RunView& run)
{
  std::vector<std::pair<std::string, Figure>> row;
  const auto add = [&](eval::PosesOf poses, const char* caption)
  {
    if (auto figure = scanFigure(run, poses)) row.emplace_back(caption, std::move(*figure));
  };
  add(eval::PosesOf::kFilter,
      "Where the laser's returns lie by the filter's estimates, each made when its scan came; "
      "without those of tracked targets.");
  add(eval::PosesOf::kPath, "The same by the whole path as the filter believes it at the end.");
  add(eval::PosesOf::kOdometry, "The same by odometry alone.");
  if (!row.empty()) page.figuresInRow(row);
}

void addPlots(HtmlPage& page, const RunView& run)
{
  page.heading("Map and paths");
  page.figure(
      "The map frame from above, one metre as long on both axes. Arrow heads mark the last "
      "poses; dashed lines are true paths.",
      mapFigure(run));
  addScans(page, run);
  const auto nees = neesFigure(run);
  if (nees) page.heading("Errors");
  addErrors(page, run);
  if (nees)
    page.figure(
        "Normalised squared errors. A consistent filter's lie in the band 95% of the time; "
        "above it, the filter is too sure of itself.",
        *nees);
  if (const auto ess = essFigure(run.record))
  {
    page.heading("Particles");
    page.figure("How many particles still count. Strokes at the foot: resampling.", *ess);
  }
}
}  // namespace

std::string titleOf(const RunInfo& info)
{
  return info.method + " on " + std::filesystem::path(info.dataset).filename().string();
}

std::string writeReport(const std::string& path, const RunInfo& info, const RunView& run)
{
  HtmlPage page(titleOf(info), "seed " + std::to_string(info.seed) + ", " +
                                   std::to_string(run.record.steps.size()) + " steps");
  if (!run.record.complete)
    page.banner(
        "INCOMPLETE: the run was interrupted, or its input ended too early. All below "
        "stands for the part up to then.");
  for (const std::string& hint : hintsOf(run.record, info.method)) page.banner("NOTE: " + hint);
  addNumbers(page, run);
  addPlots(page, run);
  page.heading("Settings");
  page.paragraph("The full effective configuration; as config.ini it repeats the run.");
  page.preformatted(info.config);
  page.heading("Versions");
  page.table({{}, {{"slamot", kVersion}, {"MRPT", mrptVersion()}}});
  writeWhole(path, page.html());
  return page.missingPlots().empty() ? std::string()
                                     : "report.html: made without plots: " + page.missingPlots();
}
}  // namespace slamot::results
