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

/// Whether what others published is of this cell.
bool isOf(const Published& p, const Plan& plan, const Cell& cell)
{
  const auto& axes = plan.spec.axes;
  for (std::size_t a = 0; a < axes.size(); ++a)
  {
    const auto it = p.byAxis.find(axes[a].name);
    if (it != p.byAxis.end() && it->second != axes[a].values[cell.values[a]]) return false;
  }
  return true;
}

/// The row of what others published, if it has any of these metrics.
/// \param cell empty: it is of none
void addPublished(const Published& p, const std::vector<std::string>& metricNames,
                  std::vector<std::string> cell, TableText& table)
{
  TableText::Row row{std::move(cell), true};
  row.fields.push_back(p.label);
  bool any = false;
  for (const std::string& name : metricNames)
  {
    const auto it = p.byMetric.find(name);
    any = any || it != p.byMetric.end();
    row.fields.push_back(it == p.byMetric.end() ? "" : it->second);
  }
  if (any) table.rows.push_back(row);
}

bool isOfMeanSquares(const std::string& name)
{
  return metrics()[*metricByName(name)].numerator != nullptr;
}

std::string noteOf(const Plan& plan, const TableSpec& table, std::optional<std::size_t> reference)
{
  std::string out =
      reference ? "Ratio of the mean to that of " + plan.spec.methods[*reference].label +
                      ", paired by seed, ± half width of its 95% interval."
                : "Mean over the runs ± half width of its 95% interval (standard deviation over "
                  "the runs).";
  if (std::any_of(table.metrics.begin(), table.metrics.end(), isOfMeanSquares))
    out +=
        "\n\nErrors by a bound, or by the efficient filter, are roots of ratios of mean squares, "
        "which is what a bound is of.";
  return out;
}

bool isShown(const TableSpec& table, const std::string& method)
{
  const auto& shown = table.methods;
  return shown.empty() || std::find(shown.begin(), shown.end(), method) != shown.end();
}

/// A method's row, and under it what others published of it.
void addRows(const Plan& plan, const Outcome& outcome, const TableSpec& spec, std::size_t cell,
             std::size_t method, std::optional<std::size_t> reference, TableText& table)
{
  TableText::Row row{rowStart(plan, cell, method), false};
  for (const std::string& name : spec.metrics)
  {
    const std::size_t k = *metricByName(name), group = plan.groupOf[cell][method];
    row.fields.push_back(reference
                             ? ratioOf(plan, outcome, group, plan.groupOf[cell][*reference], k)
                             : meanOf(plan, outcome, group, k));
  }
  table.rows.push_back(row);
  if (reference) return;
  for (const Published& p : plan.spec.published)
    if (p.method == plan.spec.methods[method].name && isOf(p, plan, plan.cells[cell]))
      addPublished(p, spec.metrics, plan.cellValues(plan.cells[cell]), table);
}
}  // namespace

TableText tableText(const Plan& plan, const Outcome& outcome, const TableSpec& spec)
{
  const auto reference = placeOf(plan.spec.methods, spec.reference);
  TableText out{spec.title,
                noteOf(plan, spec, reference),
                plan.cellLabels().size() + 1,
                head(plan, spec.metrics),
                {}};
  for (std::size_t c = 0; c < plan.cells.size(); ++c)
    for (std::size_t m = 0; m < plan.spec.methods.size(); ++m)
      if (m != reference && isShown(spec, plan.spec.methods[m].name))
        addRows(plan, outcome, spec, c, m, reference, out);
  if (reference) return out;
  for (const Published& p : plan.spec.published)
    if (p.method.empty())
      addPublished(p, spec.metrics, std::vector<std::string>(plan.cellLabels().size(), ""), out);
  return out;
}

std::vector<std::string> failureTexts(const Plan& plan, const Outcome& outcome)
{
  std::vector<std::string> out;
  for (std::size_t i = 0; i < plan.runs.size() && out.size() < kFailuresShown; ++i)
  {
    const auto& record = outcome.records[i];
    if (!record || record->error.empty()) continue;
    const Group& group = plan.groups[plan.runs[i].group];
    out.push_back(group.folder + ", seed " + std::to_string(record->seed) + ": " + record->error);
  }
  return out;
}

namespace
{
std::string markdownOf(const TableText& table)
{
  std::string out = table.title.empty() ? "\n" : "\n## " + table.title + "\n\n";
  out += table.note + "\n\n" + markdownHead(table.head);
  for (const TableText::Row& row : table.rows)
  {
    auto fields = row.fields;
    if (row.isPublished)
      for (std::string& field : fields)
        if (!field.empty()) field = "*" + field + "*";
    out += markdownLine(fields);
  }
  return out;
}

std::string failures(const Plan& plan, const Outcome& outcome)
{
  if (outcome.failed == 0) return {};
  std::string out = "\n**" + std::to_string(outcome.failed) + " of " +
                    plural(plan.runs.size(), "run") + " failed; they are in no number above.**\n\n";
  for (const std::string& text : failureTexts(plan, outcome)) out += "- " + text + "\n";
  return out;
}
}  // namespace

std::string tableMarkdown(const Plan& plan, const Outcome& outcome)
{
  std::string out = preamble(plan, outcome);
  for (const TableSpec& table : plan.spec.tables)
    out += markdownOf(tableText(plan, outcome, table));
  return out + failures(plan, outcome);
}
}  // namespace slamot::study
