#pragma once

#include <slamot/study/Outcome.h>

#include <string>

namespace slamot::study
{
/// The page: what was run, means with their 95% intervals and deviations, ratios to the reference,
/// published figures, failures.  Depends on the records' numbers only, not on who made them.
[[nodiscard]] std::string tableMarkdown(const Plan& plan, const Outcome& outcome);

/// One row for each cell, method and metric: `<cell...>,method,metric,runs,mean,std,half95,
/// ratio,ratio_half95`; ratios are to the reference, empty without one.
[[nodiscard]] std::string tableCsv(const Plan& plan, const Outcome& outcome);

/// One row for each run: `<cell...>,method,seed,error,<metric...>`; empty what is absent.
[[nodiscard]] std::string runsCsv(const Plan& plan, const Outcome& outcome);

/// One row for each group: `<cell...>,method,runs,wall_s,cpu_s`, means over its runs.  The one file
/// that differs from run to run.
[[nodiscard]] std::string timingCsv(const Plan& plan, const Outcome& outcome);
}  // namespace slamot::study
