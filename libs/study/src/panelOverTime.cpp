#include <slamot/study/ErrorCurves.h>

#include <algorithm>
#include <set>

#include "panels.h"

namespace slamot::study
{
namespace
{
std::string titleOfCurve(const Plan& plan, std::size_t cell, std::size_t method)
{
  std::string out = plan.spec.methods[method].label;
  const auto labels = plan.cellLabels(), values = plan.cellValues(plan.cells[cell]);
  for (std::size_t i = 0; i < labels.size(); ++i) out += ", " + labels[i] + " " + values[i];
  return out;
}

/// The part's values over the runs that have it.
math::MeanInterval overSeeds(const Plan& plan, const Outcome& outcome, std::size_t group,
                             const std::string& name, std::size_t part)
{
  std::vector<std::optional<double>> values;
  for (int s = 0; s < plan.spec.seeds; ++s)
  {
    const auto& record = outcome.records[plan.runAt(group, s)];
    const auto* curve = record ? record->curves.named(name) : nullptr;
    if (curve && part < curve->values.size()) values.push_back(curve->values[part]);
  }
  return statistics(values);
}

double durationOf(const Plan& plan, const Outcome& outcome, std::size_t group)
{
  double out = 0;
  for (int s = 0; s < plan.spec.seeds; ++s)
    if (const auto& record = outcome.records[plan.runAt(group, s)])
      out = std::max(out, record->curves.durationS);
  return out;
}

/// A mean over time, and the band of its 95% interval behind it.
struct TimeCurve
{
  results::Series band, line;
};
TimeCurve timeCurve(const Plan& plan, const Outcome& outcome, std::size_t group,
                    const std::string& name, results::Ink ink)
{
  using Kind = results::Series::Kind;
  TimeCurve out{{Kind::kBand, "", ink, {}, {}, {}, {}}, {Kind::kLine, "", ink, {}, {}, {}, {}}};
  const auto parts = static_cast<std::size_t>(plan.spec.timeBins);
  const double duration = durationOf(plan, outcome, group);
  for (std::size_t i = 0; i < parts; ++i)
  {
    const auto s = overSeeds(plan, outcome, group, name, i);
    if (s.count == 0) continue;
    const double middle = duration * (static_cast<double>(i) + 0.5) / static_cast<double>(parts);
    addPoint(out.band, middle, s);
    addPoint(out.line, middle, s);
  }
  return out;
}

}  // namespace

results::Plot panelOverTime(const Plan& plan, const Outcome& outcome, const PlotSpec& plot,
                            const std::string& name)
{
  results::Plot panel;
  panel.xLabel = "time since start [s]";
  panel.logY = plot.logY;
  panel.yLabel = curveLabel(name);
  std::set<std::size_t> drawn;
  std::vector<results::Series> lines;
  std::size_t curves = 0;
  for (std::size_t m = 0; m < plan.spec.methods.size(); ++m)
    for (std::size_t c = 0; c < plan.cells.size(); ++c)
    {
      if (!isShown(plan, plot, c, m) || !drawn.insert(plan.groupOf[c][m]).second) continue;
      auto curve = timeCurve(plan, outcome, plan.groupOf[c][m], name, inkOfCurve(curves++));
      if (curve.line.x.empty()) continue;
      curve.line.title = titleOfCurve(plan, c, m);
      panel.series.push_back(curve.band);
      lines.push_back(curve.line);
    }
  // Lines over all bands.
  panel.series.insert(panel.series.end(), lines.begin(), lines.end());
  return panel;
}
}  // namespace slamot::study
