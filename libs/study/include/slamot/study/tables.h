#pragma once

#include <slamot/study/Outcome.h>

#include <string>
#include <vector>

namespace slamot::study
{
/// A table as text: a row for each cell and method, and what others published among them.
struct TableText
{
  /// A line of the table.
  struct Row
  {
    std::vector<std::string> fields;  ///< as many as `head`
    bool isPublished = false;         ///< what others published, not ours
  };
  std::string title;              ///< above it
  std::string note;               ///< says what the numbers are
  std::size_t leadColumns = 1;    ///< those that name the row
  std::vector<std::string> head;  ///< of the columns
  std::vector<Row> rows;          ///< from the top
};
/// A table of the study as the page has it, intervals in the fields.
[[nodiscard]] TableText tableText(const Plan& plan, const Outcome& outcome, const TableSpec& table);

/// Which runs failed and why, at most twenty of them: one sentence for each.
[[nodiscard]] std::vector<std::string> failureTexts(const Plan& plan, const Outcome& outcome);

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
