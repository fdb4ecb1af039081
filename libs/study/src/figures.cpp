#include <slamot/study/results.h>

#include <slamot/study/Metrics.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <set>

#include "panels.h"

namespace slamot::study
{
results::Ink inkOfCurve(std::size_t n)
{
  using results::Ink;
  constexpr std::array kInks = {Ink::kVermillion, Ink::kBlue,   Ink::kOrange, Ink::kSky,
                                Ink::kGreen,      Ink::kPurple, Ink::kText,   Ink::kMuted};
  return kInks[n % kInks.size()];
}

bool isShown(const Plan& plan, const PlotSpec& plot, std::size_t cell, std::size_t method)
{
  for (const auto& [axis, value] : plot.fixed)
    if (plan.cells[cell].values[axis] != value) return false;
  const auto& shown = plot.methods;
  return shown.empty() ||
         std::find(shown.begin(), shown.end(), plan.spec.methods[method].name) != shown.end();
}

void addPoint(results::Series& series, double x, const math::MeanInterval& s)
{
  series.x.push_back(x);
  series.y.push_back(s.mean);
  series.low.push_back(s.mean - s.halfWidth95);
  series.high.push_back(s.mean + s.halfWidth95);
}

namespace
{
double numberOf(const std::string& text)
{
  double v = 0;
  std::from_chars(text.data(), text.data() + text.size(), v);  // a number, as the spec has checked
  return v;
}

/// What a curve is of: its method, and what else is varied.
std::string curveTitle(const Plan& plan, const PlotSpec& plot, std::size_t cell, std::size_t method)
{
  std::string out = plan.spec.methods[method].label;
  const auto labels = plan.cellLabels(), values = plan.cellValues(plan.cells[cell]);
  const std::size_t logs = labels.size() - plan.spec.axes.size(), x = logs + plot.axis;
  const auto isFixed = [&](std::size_t i) { return i >= logs && plot.fixed.count(i - logs) > 0; };
  for (std::size_t i = 0; i < labels.size(); ++i)
    if (i != x && !isFixed(i)) out += ", " + labels[i] + " " + values[i];
  return out;
}

/// Curves by their titles, in the order of methods: a curve has one colour in all panels.
std::map<std::string, results::Ink> inksOf(const Plan& plan, const PlotSpec& plot)
{
  std::map<std::string, results::Ink> out;
  for (std::size_t m = 0; m < plan.spec.methods.size(); ++m)
    for (std::size_t c = 0; c < plan.cells.size(); ++c)
      if (isShown(plan, plot, c, m))
        out.emplace(curveTitle(plan, plot, c, m), inkOfCurve(out.size()));
  return out;
}

std::vector<results::Series> curvesOf(const Plan& plan, const Outcome& outcome,
                                      const PlotSpec& plot, std::size_t metric)
{
  const auto inks = inksOf(plan, plot);
  std::vector<results::Series> curves;
  std::map<std::string, std::size_t> places;
  for (std::size_t m = 0; m < plan.spec.methods.size(); ++m)
    for (std::size_t c = 0; c < plan.cells.size(); ++c)
    {
      const auto s = outcome.summary(plan, plan.groupOf[c][m], metric);
      if (s.count == 0 || !isShown(plan, plot, c, m)) continue;
      const std::string title = curveTitle(plan, plot, c, m);
      const auto [it, isNew] = places.emplace(title, curves.size());
      if (isNew)
        curves.push_back(
            {results::Series::Kind::kErrorBars, title, inks.at(title), {}, {}, {}, {}});
      const Axis& axis = plan.spec.axes[plot.axis];
      addPoint(curves[it->second], numberOf(axis.values[plan.cells[c].values[plot.axis]]), s);
    }
  return curves;
}

results::Plot panelOverAxis(const Plan& plan, const Outcome& outcome, const PlotSpec& plot,
                            const std::string& name)
{
  results::Plot panel;
  panel.xLabel = plan.spec.axes[plot.axis].label;
  panel.yLabel = metrics()[*metricByName(name)].label;
  panel.logX = plot.logX, panel.logY = plot.logY;
  panel.series = curvesOf(plan, outcome, plot, *metricByName(name));
  return panel;
}
}  // namespace

results::Figure figureOf(const Plan& plan, const Outcome& outcome, const PlotSpec& plot)
{
  results::Figure figure;
  std::set<std::string> named;  // a curve is in the legend of the first panel that has it
  for (const std::string& name : plot.metrics)
  {
    results::Plot panel = plot.overTime ? panelOverTime(plan, outcome, plot, name)
                                        : panelOverAxis(plan, outcome, plot, name);
    if (figure.panels.empty()) panel.title = plot.title;
    for (results::Series& curve : panel.series)
      if (!named.insert(curve.title).second) curve.title.clear();
    figure.panels.push_back(panel);
  }
  return figure;
}
}  // namespace slamot::study
