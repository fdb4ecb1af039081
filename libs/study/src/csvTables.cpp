#include <slamot/study/Metrics.h>
#include <slamot/study/tables.h>

#include "specReading.h"
#include "tableText.h"

namespace slamot::study
{
namespace
{
/// The fields that say which cell and method a row is of.
std::vector<std::string> rowHead(const Plan& plan, std::size_t cell, std::size_t method)
{
  auto out = plan.cellValues(plan.cells[cell]);
  out.push_back(plan.spec.methods[method].name);
  return out;
}

std::vector<std::string> columnHead(const Plan& plan, const std::vector<std::string>& more)
{
  auto out = plan.cellNames();
  out.emplace_back("method");
  out.insert(out.end(), more.begin(), more.end());
  return out;
}
}  // namespace

std::string tableCsv(const Plan& plan, const Outcome& outcome)
{
  std::string out = csvLine(
      columnHead(plan, {"metric", "runs", "mean", "std", "half95", "ratio", "ratio_half95"}));
  const auto reference = placeOf(plan.spec.methods, plan.spec.reference);
  for (std::size_t c = 0; c < plan.cells.size(); ++c)
    for (std::size_t m = 0; m < plan.spec.methods.size(); ++m)
      for (std::size_t k = 0; k < metrics().size(); ++k)
      {
        const std::size_t group = plan.groupOf[c][m];
        const auto s = outcome.summary(plan, group, k);
        if (s.count == 0) continue;
        auto row = rowHead(plan, c, m);
        row.insert(row.end(), {metrics()[k].name, std::to_string(s.count), shortest(s.mean),
                               shortest(s.std), shortest(s.halfWidth95)});
        std::optional<math::MeanInterval> ratio;
        if (reference) ratio = outcome.ratio(plan, group, plan.groupOf[c][*reference], k);
        row.push_back(ratio ? shortest(ratio->mean) : "");
        row.push_back(ratio ? shortest(ratio->halfWidth95) : "");
        out += csvLine(row);
      }
  return out;
}

std::string runsCsv(const Plan& plan, const Outcome& outcome)
{
  std::vector<std::string> head = {"seed", "error"};
  for (const Metric& m : metrics()) head.emplace_back(m.name);
  std::string out = csvLine(columnHead(plan, head));
  for (std::size_t c = 0; c < plan.cells.size(); ++c)
    for (std::size_t m = 0; m < plan.spec.methods.size(); ++m)
      for (int s = 0; s < plan.spec.seeds; ++s)
      {
        const std::size_t run = plan.runAt(plan.groupOf[c][m], s);
        const auto& record = outcome.records[run];
        if (!record) continue;
        auto row = rowHead(plan, c, m);
        row.push_back(std::to_string(plan.runs[run].seed));
        row.push_back(record->error);
        for (std::size_t k = 0; k < metrics().size(); ++k)
        {
          const bool present = record->error.empty() && record->metrics[k];
          row.push_back(present ? shortest(*record->metrics[k]) : "");
        }
        out += csvLine(row);
      }
  return out;
}

std::string timingCsv(const Plan& plan, const Outcome& outcome)
{
  std::string out = csvLine(columnHead(plan, {"runs", "wall_s", "cpu_s"}));
  for (std::size_t g = 0; g < plan.groups.size(); ++g)
  {
    double wall = 0, cpu = 0;
    int count = 0;
    for (int s = 0; s < plan.spec.seeds; ++s)
      if (const auto& record = outcome.records[plan.runAt(g, s)])
        wall += record->wallS, cpu += record->cpuS, ++count;
    if (count == 0) continue;
    auto row = rowHead(plan, plan.groups[g].cell, plan.groups[g].method);
    row.insert(row.end(), {std::to_string(count), shortest(wall / count), shortest(cpu / count)});
    out += csvLine(row);
  }
  return out;
}
}  // namespace slamot::study
