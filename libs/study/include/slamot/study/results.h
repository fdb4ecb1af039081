#pragma once

#include <slamot/results/Plot.h>
#include <slamot/study/Outcome.h>

namespace slamot::study
{
/// A plot of a study: means with their 95% intervals over an axis, a curve for each method (and for
/// each combination of the other axes).
[[nodiscard]] results::Figure figureOf(const Plan& plan, const Outcome& outcome,
                                       const PlotSpec& plot);

/// Writes table.md, table.csv, runs.csv and timing.csv into a folder, each whole or not at all.
/// \throws core::Error (kUnreadable).
void saveTables(const std::string& folder, const Plan& plan, const Outcome& outcome);

/// The same, and PLOT.svg and PLOT.png of each plot, by its name.
/// \throws core::Error (kUnreadable; kInternal without gnuplot).
void saveResults(const std::string& folder, const Plan& plan, const Outcome& outcome);

/// Writes study.ini and the files that it names (config/), from which the study can be repeated.
/// \throws core::Error (kUnreadable).
void saveSpec(const std::string& folder, const StudySpec& spec);
}  // namespace slamot::study
