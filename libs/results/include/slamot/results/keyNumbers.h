#pragma once

#include <slamot/results/Figures.h>
#include <slamot/results/HtmlPage.h>

namespace slamot::results
{
/// The columns of a row of errors, the first for its name; and such a row.
[[nodiscard]] std::vector<std::string> errorHeader();
/// The cells below errorHeader(); a dash where there is no number.
[[nodiscard]] std::vector<std::string> errorRow(const std::string& name,
                                                const eval::ErrorSummary& e);

/// Errors of robot and targets; no rows without truth.
[[nodiscard]] Table errorTable(const RunView& run);

/// Landmarks, associations, particles and sizes: what applies, one row each.
[[nodiscard]] Table factTable(const RunView& run);
}  // namespace slamot::results
