#pragma once

#include <slamot/results/Figures.h>
#include <slamot/results/Summary.h>

namespace slamot::results
{
/// Writes report.html: settings, key numbers, plots.  The same run gives the same bytes.
/// \return a warning for the user where plots are missing for want of gnuplot; else empty.
/// \throws core::Error (kUnreadable) if the file can't be written.
std::string writeReport(const std::string& path, const RunInfo& info, const RunView& run);
}  // namespace slamot::results
