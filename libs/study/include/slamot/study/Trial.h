#pragma once

#include <slamot/core/run.h>
#include <slamot/eval/Evaluation.h>
#include <slamot/study/Plan.h>

#include <memory>

namespace slamot::study
{
/// One run, ready to go: where its steps come from, its truth, and the filter.  Equal cell and seed
/// give all methods the same steps.
struct Trial
{
  std::unique_ptr<core::Source> source;
  std::function<const eval::Truth&()> truth;  ///< complete once the source is at its end
  std::unique_ptr<core::Filter> filter;
  eval::EvaluationOptions evaluation;
  std::string effective;  ///< all that the result depends on, but seed and program
};

/// \throws core::Error: kConfig on a wrong scenario or method; else what is wrong with a rawlog.
[[nodiscard]] Trial openTrial(const StudySpec& spec, const Cell& cell, const Method& method,
                              std::uint64_t seed);
}  // namespace slamot::study
