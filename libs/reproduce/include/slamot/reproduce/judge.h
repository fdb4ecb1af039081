#pragma once

#include <slamot/reproduce/PaperSpec.h>
#include <slamot/study/Outcome.h>

namespace slamot::reproduce
{
/// What became of a condition in one cell.
enum class Status
{
  kMet,     ///< the whole interval is where it should be
  kOpen,    ///< the interval reaches over the bound: the runs do not decide
  kFailed,  ///< the whole interval is on the other side
  kNotRun,  ///< no runs have such a number, or the divisor is 0
  kLeftOut  ///< the quick reproduction leaves the method or the cell out
};

/// A condition in one cell, with the numbers that decided.
struct Check
{
  std::string what;                 ///< what was measured
  std::string measured;             ///< with its interval
  std::string claimed;              ///< what it is held against
  std::string remark;               ///< how far off, if it is
  Status status = Status::kNotRun;  ///< what became of it
};

/// What becomes of a claim.
enum class Verdict
{
  kHolds,        ///< every condition is met
  kInPart,       ///< some are met, or the runs do not decide
  kDoesNotHold,  ///< no condition is met, and none is open
  kNotTestable,  ///< Claim::untestable says why
  kNotRun        ///< left out of the quick reproduction, or its runs are missing
};

/// A verdict and what it rests on.
struct Judgement
{
  Verdict verdict = Verdict::kNotRun;  ///< in short
  bool isUndecided = false;            ///< in part only because nothing was decided
  std::vector<Check> checks;           ///< one for each condition and cell
};

/// Judges a claim by its study's records; nothing else enters the verdict.  All conditions met: it
/// holds; none met, and none open: it does not hold; else it holds in part.  Open is also what
/// fewer than nine of ten seeds have a number for, and a ratio whose divisor may be 0 or less.
/// \param plan, outcome of its study; null: it was not run
[[nodiscard]] Judgement judge(const Claim& claim, const study::Plan* plan,
                              const study::Outcome* outcome);

/// The status of a number that is held against a bound.
[[nodiscard]] Status statusOf(const math::MeanInterval& value, const Bound& bound);

/// "holds", "holds in part", ...
[[nodiscard]] std::string verdictText(Verdict verdict);
}  // namespace slamot::reproduce
