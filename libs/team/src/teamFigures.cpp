#include <slamot/team/teamFigures.h>

#include "series.h"

#include <slamot/math/statistics.h>

#include <algorithm>
#include <limits>

namespace slamot::team
{
namespace
{
using results::Figure;
using results::Ink;
using results::Plot;
using results::Range;
using results::Series;
using Kind = Series::Kind;

constexpr double kLeast = 1e-6;  // shown on a logarithmic axis

/// From the first to the last row of all.
Range clockOf(const TeamView& team)
{
  Range out{1e300, -1e300};
  for (const auto& robot : team.robots)
  {
    if (robot.run.record.rows.empty()) continue;
    out.min = std::min(out.min, robot.run.record.rows.front().time);
    out.max = std::max(out.max, robot.run.record.rows.back().time);
  }
  return out.min < out.max ? out : Range{0, 1};
}

Plot plotOverTime(const TeamView& team, const std::string& yLabel)
{
  const Range clock = clockOf(team);
  Plot plot;
  plot.xLabel = "time since start [s]", plot.yLabel = yLabel;
  plot.xRange = Range{0, clock.max - clock.min};
  return plot;
}

/// A curve over the steps with truth; `valueOf` gives none where there is nothing to show.
template <class ValueOf>
Series curveOf(const TeamView& team, std::size_t robot, const std::vector<eval::StepError>& steps,
               ValueOf valueOf)
{
  const auto& record = team.robots[robot].run.record;
  const double begin = clockOf(team).min;
  Series s = series(Kind::kLine, team.robots[robot].name, inkOfRobot(robot));
  for (std::size_t i = 0; i < steps.size(); ++i)
  {
    if (i > 0 && steps[i].row != steps[i - 1].row + 1 && !s.x.empty()) append(s, s.x.back(), kNaN);
    const std::optional<double> value = valueOf(steps[i]);
    if (value) append(s, record.rows[steps[i].row].time - begin, *value);
  }
  return s;
}

/// The steps with truth of each robot, or of the target as it tracks it.
std::vector<std::vector<eval::StepError>> stepsOf(const TeamView& team, bool ofTarget)
{
  std::vector<std::vector<eval::StepError>> out;
  for (const auto& robot : team.robots)
  {
    if (!ofTarget)
    {
      out.push_back(robot.run.evaluation.robot.steps);
      continue;
    }
    const auto group = targetOf(robot, team.target);
    out.push_back(group.evaluation ? group.evaluation->steps : std::vector<eval::StepError>());
  }
  return out;
}

bool headingsKnown(const std::vector<std::vector<eval::StepError>>& all)
{
  for (const auto& steps : all)
    for (const auto& s : steps)
      if (!s.headingKnown) return false;
  return true;
}

void unname(Plot& plot)
{
  for (Series& s : plot.series) s.title.clear();
}

std::optional<Figure> errorsFigure(const TeamView& team, bool ofTarget)
{
  const auto all = stepsOf(team, ofTarget);
  if (std::all_of(all.begin(), all.end(), [](const auto& s) { return s.empty(); })) return {};
  Plot position = plotOverTime(team, "position error [m]");
  Plot heading = plotOverTime(team, "heading error [deg]");
  for (std::size_t r = 0; r < all.size(); ++r)
  {
    position.series.push_back(curveOf(team, r, all[r],
                                      [](const eval::StepError& s)
                                      { return std::optional<double>(s.error.head<2>().norm()); }));
    heading.series.push_back(
        curveOf(team, r, all[r],
                [](const eval::StepError& s)
                { return std::optional<double>(math::radToDeg(std::abs(s.error[2]))); }));
  }
  position.yRange.reset();
  unname(heading);
  Figure figure{{position}};
  if (headingsKnown(all)) figure.panels.push_back(heading);
  figure.panelHeight = 180;
  return figure;
}

/// The root of the trace of a place's covariance over time; what is known exactly has none.
Series uncertaintyOf(const TeamView& team, std::size_t robot, bool ofTarget)
{
  const auto& record = team.robots[robot].run.record;
  const double begin = clockOf(team).min;
  Series s = series(Kind::kLine, team.robots[robot].name, inkOfRobot(robot));
  const auto add = [&](std::size_t row, const Matrix3& cov)
  {
    const double size = std::sqrt(std::max(cov.topLeftCorner<2, 2>().trace(), 0.0));
    if (size > kLeast) append(s, record.rows[row].time - begin, size);
  };
  if (!ofTarget)
    for (std::size_t i = 0; i < record.rows.size(); ++i) add(i, record.rows[i].robot.cov);
  else
    for (const std::size_t i : targetOf(team.robots[robot], team.target).tracks)
    {
      const auto& rows = record.targets[i].rows;
      for (std::size_t k = 0; k < rows.size(); ++k)
      {
        if (k > 0 && rows[k].row != rows[k - 1].row + 1) append(s, s.x.back(), kNaN);
        add(rows[k].row, rows[k].pose.cov);
      }
    }
  return s;
}

Series fusionMarks(const TeamView& team, std::size_t robot, bool ofTarget)
{
  const double begin = clockOf(team).min;
  Series s = series(Kind::kDots, "", inkOfRobot(robot));
  for (const fusion::FusionEvent& e : team.robots[robot].events)
  {
    if (e.receipt.outcome != fusion::Outcome::kFused) continue;
    if (ofTarget && !(e.hasTarget && e.receipt.targetFused)) continue;
    const Gaussian<Point2D>& after = ofTarget ? e.targetAfter : e.robotAfter;
    append(s, e.time - begin, std::max(std::sqrt(after.cov.trace()), kLeast));
  }
  return s;
}

Series bandOf(const Range& time, double dof)
{
  const double low = math::chiSquareQuantile(0.025, dof);
  const double high = math::chiSquareQuantile(0.975, dof);
  return {Kind::kBand, "95% of a consistent filter's",
          Ink::kMuted, {time.min, time.max},
          {},          {low, low},
          {high, high}};
}

std::optional<Plot> neesPlot(const TeamView& team, bool ofTarget)
{
  const auto all = stepsOf(team, ofTarget);
  const bool withHeading = headingsKnown(all);
  Plot plot = plotOverTime(team, std::string(ofTarget ? "target" : "robots") + ": NEES of x, y" +
                                     (withHeading ? ", heading" : ""));
  plot.logY = true;
  plot.series.push_back(bandOf(*plot.xRange, withHeading ? 3 : 2));
  double highest = 0;
  for (std::size_t r = 0; r < all.size(); ++r)
  {
    plot.series.push_back(curveOf(team, r, all[r],
                                  [&](const eval::StepError& s) -> std::optional<double>
                                  {
                                    const auto& nees = withHeading ? s.nees : s.neesPosition;
                                    if (!nees) return std::nullopt;
                                    highest = std::max(highest, *nees);
                                    return std::max(*nees, kLeast);
                                  }));
  }
  if (highest == 0) return std::nullopt;
  plot.yRange = Range{0.02, std::max(30.0, 1.5 * highest)};
  return plot;
}
}  // namespace

std::optional<Figure> robotErrorsFigure(const TeamView& team)
{
  return errorsFigure(team, false);
}

std::optional<Figure> targetErrorsFigure(const TeamView& team)
{
  return errorsFigure(team, true);
}

Figure uncertaintyFigure(const TeamView& team)
{
  Figure figure;
  figure.panelHeight = 200;
  for (const bool ofTarget : {false, true})
  {
    Plot plot = plotOverTime(team, ofTarget ? "target: deviation [m]" : "robots: deviation [m]");
    plot.logY = true;
    bool any = false;
    for (std::size_t r = 0; r < team.robots.size(); ++r)
    {
      plot.series.push_back(uncertaintyOf(team, r, ofTarget));
      any = any || !plot.series.back().x.empty();
      plot.series.push_back(fusionMarks(team, r, ofTarget));
    }
    if (!any) continue;
    if (!figure.panels.empty()) unname(plot);
    figure.panels.push_back(plot);
  }
  if (figure.panels.empty()) figure.panels.push_back(plotOverTime(team, "deviation [m]"));
  return figure;
}

std::optional<Figure> teamNeesFigure(const TeamView& team)
{
  Figure figure;
  figure.panelHeight = 200;
  for (const bool ofTarget : {false, true})
    if (auto plot = neesPlot(team, ofTarget))
    {
      if (!figure.panels.empty()) unname(*plot);
      figure.panels.push_back(std::move(*plot));
    }
  return figure.panels.empty() ? std::nullopt : std::optional<Figure>(figure);
}

std::optional<Figure> omegaFigure(const TeamView& team)
{
  const double begin = clockOf(team).min;
  Plot plot = plotOverTime(team, "own weight \u03c9");
  plot.yRange = Range{0, 1.05};
  bool any = false;
  for (std::size_t r = 0; r < team.robots.size(); ++r)
  {
    Series s = series(Kind::kDots, team.robots[r].name, inkOfRobot(r));
    for (const fusion::FusionEvent& e : team.robots[r].events)
      if (e.receipt.outcome == fusion::Outcome::kFused) append(s, e.time - begin, e.receipt.omega);
    any = any || !s.x.empty();
    plot.series.push_back(s);
  }
  if (!any) return std::nullopt;
  Figure figure{{plot}};
  figure.panelHeight = 160;
  return figure;
}
}  // namespace slamot::team
