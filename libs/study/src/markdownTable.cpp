#include <slamot/core/version.h>
#include <slamot/results/TextFile.h>
#include <slamot/study/Metrics.h>
#include <slamot/study/tables.h>

#include <algorithm>
#include <cmath>

#include "specReading.h"
#include "tableText.h"

namespace slamot::study
{
namespace
{
constexpr int kRatioDecimals = 3;
constexpr std::size_t kFailuresShown = 20;

constexpr double kTooLong = 1e5;  // to be written out

std::string fixed(double value, int decimals)
{
  if (std::abs(value) >= kTooLong) return scientific(value);
  std::string out;
  results::appendFixed(out, value, decimals);
  return out;
}

std::string plural(std::size_t n, const char* what)
{
  return std::to_string(n) + " " + what + (n == 1 ? "" : "s");
}

std::vector<std::string> head(const Plan& plan, const std::vector<std::string>& metricNames)
{
  auto out = plan.cellLabels();
  out.emplace_back("method");
  for (const std::string& name : metricNames)
    out.emplace_back(metrics()[*metricByName(name)].label);
  return out;
}

std::vector<std::string> rowStart(const Plan& plan, std::size_t cell, std::size_t method)
{
  auto out = plan.cellValues(plan.cells[cell]);
  out.push_back(plan.spec.methods[method].label);
  return out;
}

std::string preamble(const Plan& plan, const Outcome& outcome)
{
  const StudySpec& spec = plan.spec;
  std::string out = "# " + spec.title + "\n\n`slamot study " + spec.name + "`, slamot " + kVersion +
                    ": " + plural(static_cast<std::size_t>(spec.seeds), "seed") + " from " +
                    std::to_string(spec.firstSeed) + ", the same data for all methods.";
  if (!spec.note.empty()) out += " " + spec.note;
  out += "\n";
  if (outcome.missing > 0)
    out += "\n**Incomplete: " + std::to_string(outcome.missing) + " of " +
           plural(plan.runs.size(), "run") + " are missing.**\n";
  return out;
}

std::string meanOf(const Plan& plan, const Outcome& outcome, std::size_t group, std::size_t metric)
{
  const auto s = outcome.summary(plan, group, metric);
  if (s.count == 0) return "-";
  const int d = metrics()[metric].decimals;
  if (s.count == 1) return fixed(s.mean, d);  // one run has no spread to tell
  return fixed(s.mean, d) + " ± " + fixed(s.halfWidth95, d) + " (" + fixed(s.std, d) + ")";
}

std::string ratioOf(const Plan& plan, const Outcome& outcome, std::size_t group,
                    std::size_t reference, std::size_t metric)
{
  const auto r = outcome.ratio(plan, group, reference, metric);
  return r ? fixed(r->mean, kRatioDecimals) + " ± " + fixed(r->halfWidth95, kRatioDecimals) : "-";
}

std::string publishedRows(const Plan& plan, const TableSpec& table)
{
  std::string out;
  for (const Published& p : plan.spec.published)
  {
    std::vector<std::string> row(plan.cellLabels().size(), "");
    row.push_back("*" + p.label + "*");
    bool any = false;
    for (const std::string& name : table.metrics)
    {
      const auto it = p.byMetric.find(name);
      any = any || it != p.byMetric.end();
      row.push_back(it == p.byMetric.end() ? "" : "*" + it->second + "*");
    }
    if (any) out += markdownLine(row);
  }
  return out;
}

bool isOfMeanSquares(const std::string& name)
{
  return metrics()[*metricByName(name)].numerator != nullptr;
}

std::string tableOf(const Plan& plan, const Outcome& outcome, const TableSpec& table)
{
  const StudySpec& spec = plan.spec;
  const auto reference = placeOf(spec.methods, table.reference);
  std::string out = table.title.empty() ? "\n" : "\n## " + table.title + "\n\n";
  out += reference ? "Ratio of the mean to that of " + spec.methods[*reference].label +
                            ", paired by seed, ± half width of its 95% interval.\n\n"
                      : "Mean over the runs ± half width of its 95% interval (standard deviation "
                        "over the runs).\n\n";
  if (std::any_of(table.metrics.begin(), table.metrics.end(), isOfMeanSquares))
    out +=
        "Errors by a bound, or by the efficient filter, are roots of ratios of mean squares, which "
        "is what a bound is of.\n\n";
  out += markdownHead(head(plan, table.metrics));
  for (std::size_t c = 0; c < plan.cells.size(); ++c)
    for (std::size_t m = 0; m < spec.methods.size(); ++m)
    {
      if (reference && m == *reference) continue;
      auto row = rowStart(plan, c, m);
      for (const std::string& name : table.metrics)
      {
        const std::size_t k = *metricByName(name), group = plan.groupOf[c][m];
        row.push_back(reference ? ratioOf(plan, outcome, group, plan.groupOf[c][*reference], k)
                                   : meanOf(plan, outcome, group, k));
      }
      out += markdownLine(row);
    }
  return reference ? out : out + publishedRows(plan, table);
}

std::string failures(const Plan& plan, const Outcome& outcome)
{
  if (outcome.failed == 0) return {};
  std::string out = "\n**" + std::to_string(outcome.failed) + " of " +
                    plural(plan.runs.size(), "run") + " failed; they are in no number above.**\n\n";
  std::size_t shown = 0;
  for (std::size_t i = 0; i < plan.runs.size() && shown < kFailuresShown; ++i)
  {
    const auto& record = outcome.records[i];
    if (!record || record->error.empty()) continue;
    const Group& group = plan.groups[plan.runs[i].group];
    out += "- " + group.folder + ", seed " + std::to_string(record->seed) + ": " + record->error +
           "\n";
    ++shown;
  }
  return out;
}
}  // namespace

std::string tableMarkdown(const Plan& plan, const Outcome& outcome)
{
  std::string out = preamble(plan, outcome);
  for (const TableSpec& table : plan.spec.tables) out += tableOf(plan, outcome, table);
  return out + failures(plan, outcome);
}
}  // namespace slamot::study
