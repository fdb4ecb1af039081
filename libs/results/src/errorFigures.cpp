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
void append(ErrorTrack& track, const RunView& run, const std::vector<eval::StepError>& steps,
            CovOf covOf)
{
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
}

/// Shows all of the errors and most of the bounds: those of a target long unseen would dwarf all.
Range errorRange(const std::vector<double>& error, const std::vector<double>& bound, double most)
{
  double limit = 0;
  std::vector<double> finite;
  for (const double e : error)
    if (std::isfinite(e)) limit = std::max(limit, std::abs(e));
  for (const double b : bound)
    if (std::isfinite(b)) finite.push_back(b);
  if (!finite.empty()) limit = std::max(limit, 1.5 * math::quantile(finite, 0.5));
  limit = std::min(limit, most);
  return limit > 0 ? Range{-1.1 * limit, 1.1 * limit} : Range{-1, 1};
}

/// The errors of one axis; a heading that goes over half a turn breaks the line.
Series errorLine(const ErrorTrack& track, int axis, double unit)
{
  Series line{Kind::kLine, axis == 0 ? "error" : "", Ink::kBlue, {}, {}, {}, {}};
  for (std::size_t i = 0; i < track.time.size(); ++i)
  {
    const double e = unit * track.error[i][axis];
    if (axis == 2 && i > 0 && std::abs(e - line.y.back()) > 180)
      line.x.push_back(track.time[i]), line.y.push_back(kNaN);
    line.x.push_back(track.time[i]);
    line.y.push_back(e);
  }
  return line;
}

Plot errorPlot(const ErrorTrack& track, int axis, Ink ink, const Range& time)
{
  constexpr const char* kLabels[] = {"error of x [m]", "error of y [m]", "error of heading [deg]"};
  const double unit = axis == 2 ? math::radToDeg(1) : 1;
  Series line = errorLine(track, axis, unit);
  line.ink = ink;
  Series band{Kind::kBand, axis == 0 ? "bounds of three standard deviations" : "",
              Ink::kMuted, track.time,
              {},          {},
              {}};
  for (const Vector3& deviation : track.deviation) band.high.push_back(3 * unit * deviation[axis]);
  Plot plot;
  plot.xLabel = "time since start [s]", plot.yLabel = kLabels[axis];
  plot.xRange = time;
  plot.yRange = errorRange(line.y, band.high, axis == 2 ? 180 : 1e9);
  for (double& b : band.high)
  {
    b = std::isfinite(b) ? std::min(b, plot.yRange->max) : b;
    band.low.push_back(-b);
  }
  plot.series = {band, line};
  return plot;
}

Range timeRange(const eval::Record& record)
{
  return {0, std::max(record.rows.back().time - record.rows.front().time, 1e-3)};
}

std::optional<Figure> errorFigure(const ErrorTrack& track, Ink ink, const eval::Record& record)
{
  if (track.time.empty()) return std::nullopt;
  Figure figure;
  figure.panelHeight = 150;
  for (int axis = 0; axis < (track.headingKnown ? 3 : 2); ++axis)
    figure.panels.push_back(errorPlot(track, axis, ink, timeRange(record)));
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
  ErrorTrack track;
  const auto covOf = [&](std::size_t row) { return run.record.rows[row].robot.cov; };
  append(track, run, run.evaluation.robot.steps, covOf);
  return errorFigure(track, Ink::kBlue, run.record);
}

std::optional<Figure> targetErrorFigure(const RunView& run, const TargetGroup& group, Ink ink)
{
  if (!group.evaluation) return std::nullopt;
  ErrorTrack errors;
  for (const std::size_t i : group.tracks)
  {
    const auto& rows = run.record.targets[i].rows;
    const auto covOf = [&](std::size_t row) -> Matrix3
    {
      const auto before = [](const eval::TargetRow& r, std::size_t wanted)
      { return r.row < wanted; };
      return std::lower_bound(rows.begin(), rows.end(), row, before)->pose.cov;
    };
    errors.gap();
    append(errors, run, run.evaluation.targets[i].steps, covOf);
  }
  return errorFigure(errors, ink, run.record);
}

std::optional<Figure> essFigure(const eval::Record& record)
{
  if (record.rows.empty()) return std::nullopt;
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
  plot.xRange = timeRange(record);
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
  const auto groups = targetGroups(run.record, run.evaluation);
  for (std::size_t g = 0; g < groups.size(); ++g)
    if (groups[g].evaluation)
      curves.push_back(
          neesOf(run.record, groups[g].evaluation->steps, withHeading, groups[g].name, inkOf(g)));
  double highest = 0;
  for (const Series& s : curves)
    for (const double y : s.y) highest = std::isfinite(y) ? std::max(highest, y) : highest;
  if (highest == 0) return std::nullopt;
  const Range time = timeRange(run.record);
  const double low = math::chiSquareQuantile(0.025, dof),
               high = math::chiSquareQuantile(0.975, dof);
  plot.series = {{Kind::kBand,
                  "95% of a consistent filter's",
                  Ink::kMuted,
                  {time.min, time.max},
                  {},
                  {low, low},
                  {high, high}}};
  plot.series.insert(plot.series.end(), curves.begin(), curves.end());
  plot.xRange = time;
  plot.yRange = Range{0.02, std::max(30.0, 1.5 * highest)};
  return Figure{{plot}};
}
}  // namespace slamot::results
