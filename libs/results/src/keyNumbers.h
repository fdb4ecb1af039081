#pragma once

#include <slamot/results/Figures.h>
#include <slamot/results/HtmlPage.h>

namespace slamot::results
{
/// Errors of robot and targets; no rows without truth.
[[nodiscard]] Table errorTable(const RunView& run);

/// Landmarks, associations, particles and sizes: what applies, one row each.
[[nodiscard]] Table factTable(const RunView& run);
}  // namespace slamot::results
