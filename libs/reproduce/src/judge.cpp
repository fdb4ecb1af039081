#include <slamot/reproduce/judge.h>

#include <algorithm>
#include <cmath>

#include "conditionText.h"
#include "measured.h"

namespace slamot::reproduce
{
namespace
{
constexpr double kEnough = 0.9;  // of the seeds have to have the number

Status whole(bool isInside, bool isOutside)
{
  if (isInside) return Status::kMet;
  return isOutside ? Status::kFailed : Status::kOpen;
}

/// Against a published mean and its deviation: met if ours lies within, failed if no part of the
/// interval does.
Status againstDeviation(const math::MeanInterval& v, const Bound& b)
{
  const double low =
      b.kind == Bound::Kind::kAtMostPublished ? -INFINITY : b.published - *b.deviation;
  const double high =
      b.kind == Bound::Kind::kAtLeastPublished ? INFINITY : b.published + *b.deviation;
  const bool isInside = v.mean >= low && v.mean <= high;
  return whole(isInside, v.mean - v.halfWidth95 > high || v.mean + v.halfWidth95 < low);
}

/// Against a published mean of some runs: whether as many runs of ours could have given it.
Status againstRuns(const math::MeanInterval& v, const Bound& b)
{
  const double half = predictionHalf(v, *b.runs), off = v.mean - b.published;
  if (b.kind == Bound::Kind::kAtMostPublished) return off <= half ? Status::kMet : Status::kFailed;
  if (b.kind == Bound::Kind::kAtLeastPublished)
    return off >= -half ? Status::kMet : Status::kFailed;
  return std::abs(off) <= half ? Status::kMet : Status::kFailed;
}

Verdict verdictOf(const std::vector<Check>& checks)
{
  const auto count = [&](Status s)
  {
    return std::count_if(checks.begin(), checks.end(),
                         [s](const Check& c) { return c.status == s; });
  };
  const auto met = count(Status::kMet), open = count(Status::kOpen),
             failed = count(Status::kFailed);
  if (met + open + failed == 0) return Verdict::kNotRun;
  // What could not be looked at is not known to hold.
  if (open == 0 && failed == 0 && count(Status::kNotRun) == 0) return Verdict::kHolds;
  return met + open == 0 ? Verdict::kDoesNotHold : Verdict::kInPart;
}

Check checkOf(const Claim::Part& part, const Measured& measured, const study::Plan& plan)
{
  Check out;
  out.what = wordsOf(part, plan);
  if (!measured.cell.empty()) out.what += ", " + measured.cell;
  out.claimed = claimedText(part.condition);
  if (measured.value.count == 0) return out;
  // A ratio tells nothing of which is larger where its divisor may be 0 or less, and runs that have
  // no number, of a target that was never found, may be the worst.
  const bool isDecisive = measured.isByPositive && measured.value.count >= kEnough * measured.seeds;
  out.status = isDecisive ? statusOf(measured.value, part.condition.bound) : Status::kOpen;
  out.measured = measuredText(measured, part.condition);
  out.remark = remarkOf(measured, part.condition, out.status);
  return out;
}
}  // namespace

Status statusOf(const math::MeanInterval& v, const Bound& b)
{
  if (v.count == 0) return Status::kNotRun;
  // One run has no interval.
  if (v.count == 1) return Status::kOpen;
  const double low = v.mean - v.halfWidth95, high = v.mean + v.halfWidth95;
  switch (b.kind)
  {
    case Bound::Kind::kBelow:
      return whole(high < b.high, low >= b.high);
    case Bound::Kind::kAbove:
      return whole(low > b.low, high <= b.low);
    case Bound::Kind::kBetween:
      return whole(low >= b.low && high <= b.high, low > b.high || high < b.low);
    default:
      return b.deviation ? againstDeviation(v, b) : againstRuns(v, b);
  }
}

Judgement judge(const Claim& claim, const study::Plan* plan, const study::Outcome* outcome)
{
  Judgement out;
  if (!claim.untestable.empty())
  {
    out.verdict = Verdict::kNotTestable;
    return out;
  }
  if (!plan || !outcome) return out;
  for (const Claim::Part& part : claim.parts)
  {
    const auto measured = measure(part.condition, *plan, *outcome);
    for (const Measured& m : measured) out.checks.push_back(checkOf(part, m, *plan));
    if (measured.empty())
      out.checks.push_back(
          {wordsOf(part, *plan), "", claimedText(part.condition), "", Status::kLeftOut});
  }
  out.verdict = verdictOf(out.checks);
  const auto isDecided = [](const Check& c)
  { return c.status == Status::kMet || c.status == Status::kFailed; };
  out.isUndecided = out.verdict == Verdict::kInPart &&
                    std::none_of(out.checks.begin(), out.checks.end(), isDecided);
  return out;
}

std::string verdictText(Verdict verdict)
{
  switch (verdict)
  {
    case Verdict::kHolds:
      return "holds";
    case Verdict::kInPart:
      return "holds in part";
    case Verdict::kDoesNotHold:
      return "does not hold";
    case Verdict::kNotTestable:
      return "not testable";
    case Verdict::kNotRun:
      break;
  }
  return "not run";
}
}  // namespace slamot::reproduce
