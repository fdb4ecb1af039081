#include "conditionText.h"

#include <slamot/results/TextFile.h>

#include <charconv>
#include <cmath>

namespace slamot::reproduce
{
namespace
{
constexpr int kRatioDecimals = 3;

std::string fixed(double value, int decimals)
{
  std::string out;
  results::appendFixed(out, value, decimals);
  return out;
}

std::string shortest(double value)
{
  char text[40];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  return {text, end};
}

std::string methodLabel(const std::string& name, const study::Plan& plan)
{
  for (const study::Method& m : plan.spec.methods)
    if (m.name == name) return m.label;
  return name;
}

std::string axisLabel(const std::string& name, const study::Plan& plan)
{
  for (const study::Axis& a : plan.spec.axes)
    if (a.name == name) return a.label;
  return name;
}

std::string wordsOf(const Term& term, const study::Plan& plan)
{
  std::string out = labelOf(term.metric) + " of " + methodLabel(term.method, plan);
  for (const auto& [axis, value] : term.cell) out += ", " + axisLabel(axis, plan) + " " + value;
  return out;
}

std::string wordsOf(const std::vector<Term>& sum, const study::Plan& plan)
{
  std::string out;
  for (const Term& term : sum)
    out += (out.empty() ? "" : term.isTakenAway ? " less " : " and ") + wordsOf(term, plan);
  return out;
}

int decimalsFor(const Condition& condition)
{
  if (!condition.divisor.empty()) return kRatioDecimals;
  return decimalsOf(condition.sum.front().metric);
}
}  // namespace

double predictionHalf(const math::MeanInterval& value, int runs)
{
  return value.halfWidth95 * std::sqrt(1.0 + static_cast<double>(value.count) / runs);
}

std::string wordsOf(const Claim::Part& part, const study::Plan& plan)
{
  if (!part.label.empty()) return part.label;
  const Condition& c = part.condition;
  std::string out = wordsOf(c.sum, plan);
  if (!c.divisor.empty()) out += ", by " + wordsOf(c.divisor, plan);
  return out;
}

std::string measuredText(const Measured& measured, const Condition& condition)
{
  const math::MeanInterval& value = measured.value;
  const int d = decimalsFor(condition);
  std::string of;
  if (value.count < measured.seeds)
    of = " (" + std::to_string(value.count) + " of " + std::to_string(measured.seeds) + " runs)";
  else if (value.count == 1)
    of = " (one run)";
  return fixed(value.mean, d) + (value.count > 1 ? " ± " + fixed(value.halfWidth95, d) : "") + of;
}

std::string claimedText(const Condition& condition)
{
  const Bound& b = condition.bound;
  std::string published = "published " + shortest(b.published);
  if (b.deviation) published += " (" + shortest(*b.deviation) + ")";
  if (b.runs) published += ", " + std::to_string(*b.runs) + " runs";
  switch (b.kind)
  {
    case Bound::Kind::kBelow:
      return "below " + shortest(b.high);
    case Bound::Kind::kAbove:
      return "above " + shortest(b.low);
    case Bound::Kind::kBetween:
      return shortest(b.low) + " to " + shortest(b.high);
    case Bound::Kind::kAtMostPublished:
      return published + ", or less";
    case Bound::Kind::kAtLeastPublished:
      return published + ", or more";
    case Bound::Kind::kAsPublished:
      break;
  }
  return published;
}

std::string remarkOf(const Measured& measured, const Condition& condition, Status status)
{
  const math::MeanInterval& value = measured.value;
  const Bound& bound = condition.bound;
  if (!measured.isByPositive) return "what it is divided by may be 0 or less";
  const bool isPublished = bound.deviation || bound.runs;
  if (!isPublished) return {};
  const double off = value.mean - bound.published;
  const std::string side = off < 0 ? " below" : " above";
  std::string out;
  if (bound.deviation)
    out = fixed(std::abs(off) / *bound.deviation, 1) + " deviations" + side;
  else if (bound.published != 0)
    out = fixed(100 * std::abs(off / bound.published), 0) + "%" + side;
  if (status == Status::kFailed && off < 0 && bound.kind == Bound::Kind::kAsPublished)
    out += ": smaller than published";
  if (bound.runs)
  {
    const double half = predictionHalf(value, *bound.runs);
    const int d = decimalsFor(condition);
    out += "; " + std::to_string(*bound.runs) + " runs here would give " +
           fixed(value.mean - half, d) + " to " + fixed(value.mean + half, d);
  }
  return out;
}
}  // namespace slamot::reproduce
