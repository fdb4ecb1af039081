#pragma once

#include <slamot/results/Plot.h>
#include <slamot/study/Outcome.h>

namespace slamot::study
{
/// Colours of a figure's curves, by their number; they repeat after the last.
[[nodiscard]] results::Ink inkOfCurve(std::size_t n);

/// Whether a plot has a curve of a method in a cell.
[[nodiscard]] bool isShown(const Plan& plan, const PlotSpec& plot, std::size_t cell,
                           std::size_t method);

/// A mean with its interval, at x.
void addPoint(results::Series& series, double x, const math::MeanInterval& s);

/// Mean errors over a run's time with bands of their 95% intervals, a line for each group.
/// \param name of the curve, see ErrorCurves
[[nodiscard]] results::Plot panelOverTime(const Plan& plan, const Outcome& outcome,
                                          const PlotSpec& plot, const std::string& name);
}  // namespace slamot::study
