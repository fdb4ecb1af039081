#include <slamot/results/Figures.h>

#include <slamot/math/statistics.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace slamot::results
{
namespace
{
using Kind = Series::Kind;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Errors and their deviations along one track, in the truth's axes.
struct ErrorTrack
{
  std::vector<double> time;               ///< [s] since the run's start
  std::vector<Vector3> error, deviation;  ///< NaN in a gap
  bool headingKnown = false;

  void gap()
  {
    if (time.empty()) return;
    time.push_back(time.back());
    error.push_back(Vector3::Constant(kNaN));
    deviation.push_back(Vector3::Constant(kNaN));
  }
};

double timeOf(const eval::Record& record, std::size_t row)
{
  return record.rows[row].time - record.rows.front().time;
}

/// \param covOf the covariance, in map axes, of the estimate at a row.
template <class CovOf>
ErrorTrack errorTrack(const RunView& run, const std::vector<eval::StepError>& steps, CovOf covOf)
{
  ErrorTrack track;
  const Matrix3 r = math::poseRotation(run.evaluation.truthFromMap.phi);
  for (std::size_t i = 0; i < steps.size(); ++i)
  {
    if (i > 0 && steps[i].row != steps[i - 1].row + 1) track.gap();
    const Matrix3 cov = r * covOf(steps[i].row) * r.transpose();
    Vector3 error = steps[i].error;
    track.headingKnown = track.headingKnown || steps[i].headingKnown;
    if (!steps[i].headingKnown) error[2] = kNaN;
    track.time.push_back(timeOf(run.record, steps[i].row));
    track.error.push_back(error);
    track.deviation.push_back(cov.diagonal().cwiseMax(0).cwiseSqrt());
  }
  return track;
}

/// Shows all of the errors and most of the bounds: those of a target long unseen would dwarf all.
Range errorRange(const std::vector<double>& error, const std::vector<double>& bound)
{
  double limit = 0;
  std::vector<double> finite;
  for (std::size_t i = 0; i < error.size(); ++i)
  {
    if (std::isfinite(error[i])) limit = std::max(limit, std::abs(error[i]));
    if (std::isfinite(bound[i])) finite.push_back(bound[i]);
  }
  if (!finite.empty()) limit = std::max(limit, math::quantile(finite, 0.98));
  return limit > 0 ? Range{-1.1 * limit, 1.1 * limit} : Range{-1, 1};
}

Plot errorPlot(const ErrorTrack& track, int axis, Ink ink)
{
  constexpr const char* kLabels[] = {"error of x [m]", "error of y [m]", "error of heading [deg]"};
  const double unit = axis == 2 ? math::radToDeg(1) : 1;
  Series band{
      Kind::kBand, axis == 0 ? "bounds of three standard deviations" : "", Ink::kMuted, {}, {}, {},
      {}};
  Series line{Kind::kLine, axis == 0 ? "error" : "", ink, {}, {}, {}, {}};
  for (std::size_t i = 0; i < track.time.size(); ++i)
  {
    line.y.push_back(unit * track.error[i][axis]);
    band.high.push_back(3 * unit * track.deviation[i][axis]);
    band.low.push_back(-band.high.back());
  }
  band.x = line.x = track.time;
  Plot plot;
  plot.xLabel = "time since start [s]", plot.yLabel = kLabels[axis];
  plot.yRange = errorRange(line.y, band.high);
  for (auto* values : {&band.low, &band.high})
    for (double& v : *values)
      v = std::isfinite(v) ? std::clamp(v, plot.yRange->min, plot.yRange->max) : v;
  plot.series = {band, line};
  return plot;
}

std::optional<Figure> errorFigure(const ErrorTrack& track, Ink ink)
{
  if (track.time.empty()) return std::nullopt;
  Figure figure;
  figure.panelHeight = 150;
  for (int axis = 0; axis < (track.headingKnown ? 3 : 2); ++axis)
    figure.panels.push_back(errorPlot(track, axis, ink));
  return figure;
}

Series neesOf(const eval::Record& record, const std::vector<eval::StepError>& steps,
              bool withHeading, const std::string& title, Ink ink)
{
  Series s{Kind::kLine, title, ink, {}, {}, {}, {}};
  for (std::size_t i = 0; i < steps.size(); ++i)
  {
    const auto& nees = withHeading ? steps[i].nees : steps[i].neesPosition;
    const bool gap = i > 0 && steps[i].row != steps[i - 1].row + 1;
    if (gap && !s.x.empty()) s.x.push_back(s.x.back()), s.y.push_back(kNaN);
    if (!nees) continue;
    s.x.push_back(timeOf(record, steps[i].row));
    s.y.push_back(std::max(*nees, 1e-6));  // the axis is logarithmic
  }
  return s;
}

bool allHeadingsKnown(const eval::Evaluation& e)
{
  const auto known = [](const std::vector<eval::StepError>& steps)
  { return std::all_of(steps.begin(), steps.end(), [](const auto& s) { return s.headingKnown; }); };
  bool all = known(e.robot.steps);
  for (const auto& t : e.targets) all = all && known(t.steps);
  return all;
}
}  // namespace

std::optional<Figure> robotErrorFigure(const RunView& run)
{
  const auto covOf = [&](std::size_t row) { return run.record.rows[row].robot.cov; };
  return errorFigure(errorTrack(run, run.evaluation.robot.steps, covOf), Ink::kBlue);
}

std::optional<Figure> targetErrorFigure(const RunView& run, std::size_t target)
{
  if (target >= run.evaluation.targets.size()) return std::nullopt;
  const auto& rows = run.record.targets.at(target).rows;
  const auto covOf = [&](std::size_t row) -> Matrix3
  {
    const auto before = [](const eval::TargetRow& r, std::size_t wanted) { return r.row < wanted; };
    return std::lower_bound(rows.begin(), rows.end(), row, before)->pose.cov;
  };
  return errorFigure(errorTrack(run, run.evaluation.targets[target].steps, covOf), inkOf(target));
}

std::optional<Figure> essFigure(const eval::Record& record)
{
  Series ess{Kind::kLine, "effective sample size", Ink::kBlue, {}, {}, {}, {}};
  Series ticks{Kind::kTicks, "resampled", Ink::kVermillion, {}, {}, {}, {}};
  for (const auto& step : record.steps)
  {
    const double t = step.time - record.rows.front().time;
    if (step.ess) ess.x.push_back(t), ess.y.push_back(*step.ess);
    if (step.resampled) ticks.x.push_back(t);
  }
  if (ess.x.empty()) return std::nullopt;
  Plot plot;
  plot.xLabel = "time since start [s]", plot.yLabel = "particles";
  plot.yRange = Range{0, 1.05 * std::max<double>(record.particles, 1)};
  plot.series = {ticks, ess};
  Figure figure{{plot}};
  figure.panelHeight = 180;
  return figure;
}

std::optional<Figure> neesFigure(const RunView& run)
{
  const bool withHeading = allHeadingsKnown(run.evaluation);
  const double dof = withHeading ? 3 : 2;
  Plot plot;
  plot.logY = true;
  plot.xLabel = "time since start [s]";
  plot.yLabel = withHeading ? "NEES of x, y, heading" : "NEES of x, y";
  std::vector<Series> curves{
      neesOf(run.record, run.evaluation.robot.steps, withHeading, "robot", Ink::kBlue)};
  for (std::size_t i = 0; i < run.record.targets.size() && i < run.evaluation.targets.size(); ++i)
    curves.push_back(neesOf(run.record, run.evaluation.targets[i].steps, withHeading,
                            nameOf(run.record.targets[i]), inkOf(i)));
  double last = 0, highest = 0;
  for (const Series& s : curves)
    for (std::size_t i = 0; i < s.x.size(); ++i)
      last = std::max(last, s.x[i]),
      highest = std::isfinite(s.y[i]) ? std::max(highest, s.y[i]) : highest;
  if (highest == 0) return std::nullopt;
  const double low = math::chiSquareQuantile(0.025, dof),
               high = math::chiSquareQuantile(0.975, dof);
  plot.series = {{Kind::kBand,
                  "95% of a consistent filter's",
                  Ink::kMuted,
                  {0, last},
                  {},
                  {low, low},
                  {high, high}}};
  plot.series.insert(plot.series.end(), curves.begin(), curves.end());
  plot.yRange = Range{0.02, std::max(30.0, 1.5 * highest)};
  return Figure{{plot}};
}
}  // namespace slamot::results
