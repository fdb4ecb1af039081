#pragma once

#include <slamot/results/Figures.h>
#include <slamot/results/Summary.h>

namespace slamot::results
{
/// What a run's page and scene are headed with: method and log.
[[nodiscard]] std::string titleOf(const RunInfo& info);

/// Writes report.html: settings, key numbers, plots.  The same run gives the same bytes.
/// \return a warning for the user where plots are missing for want of gnuplot; else empty.
/// \throws core::Error (kUnreadable) if the file can't be written.
std::string writeReport(const std::string& path, const RunInfo& info, const RunView& run);
}  // namespace slamot::results
