#include "measured.h"

#include <slamot/study/Metrics.h>

#include <algorithm>

namespace slamot::reproduce
{
namespace
{
using study::Cell;
using study::Outcome;
using study::Plan;
using Values = std::vector<std::optional<double>>;

template <class List, class Is>
std::optional<std::size_t> placeOf(const List& list, Is&& is)
{
  const auto it = std::find_if(list.begin(), list.end(), is);
  if (it == list.end()) return std::nullopt;
  return static_cast<std::size_t>(it - list.begin());
}

/// The places of the axes that a term names, and of their values; none if the study has not one.
using Named = std::vector<std::pair<std::size_t, std::size_t>>;
std::optional<Named> namedIn(const Term& term, const Plan& plan)
{
  Named out;
  for (const auto& [name, value] : term.cell)
  {
    const auto axis = placeOf(plan.spec.axes, [&n = name](const auto& a) { return a.name == n; });
    if (!axis) return std::nullopt;
    const auto place =
        placeOf(plan.spec.axes[*axis].values, [&v = value](const auto& x) { return x == v; });
    if (!place) return std::nullopt;
    out.emplace_back(*axis, *place);
  }
  return out;
}

/// The cell that differs from another in the axes that are named.
std::size_t cellAt(const Plan& plan, std::size_t other, const Named& named)
{
  Cell wanted = plan.cells[other];
  for (const auto& [axis, value] : named) wanted.values[axis] = value;
  return *placeOf(plan.cells, [&](const Cell& c)
                  { return c.rawlog == wanted.rawlog && c.values == wanted.values; });
}

Values valuesOf(const Plan& plan, const Outcome& outcome, std::size_t group,
                const std::string& metric)
{
  if (metric != kCpuTime) return outcome.values(plan, group, *study::metricByName(metric));
  Values out;
  for (int s = 0; s < plan.spec.seeds; ++s)
  {
    const auto& record = outcome.records[plan.runAt(group, s)];
    const bool isGood = record && record->error.empty();
    out.push_back(isGood ? std::optional<double>(record->cpuS) : std::nullopt);
  }
  return out;
}

/// A term in one cell.
struct Placed
{
  const Term* term;
  std::size_t group;
};

Values sumOf(const std::vector<Placed>& terms, const Plan& plan, const Outcome& outcome)
{
  Values out;
  for (const Placed& t : terms)
  {
    const Values values = valuesOf(plan, outcome, t.group, t.term->metric);
    if (out.empty()) out.assign(values.size(), 0.0);
    for (std::size_t i = 0; i < out.size(); ++i)
    {
      if (!values[i]) out[i].reset();
      if (out[i]) *out[i] += t.term->isTakenAway ? -*values[i] : *values[i];
    }
  }
  return out;
}

/// All terms, at the cell of the first; none if a method is not there.
std::optional<std::vector<Placed>> place(const std::vector<Term>& sum, const Plan& plan,
                                         std::size_t base)
{
  std::vector<Placed> out;
  for (const Term& term : sum)
  {
    const auto method =
        placeOf(plan.spec.methods, [&](const auto& m) { return m.name == term.method; });
    const auto named = namedIn(term, plan);
    if (!method || !named) return std::nullopt;
    out.push_back({&term, plan.groupOf[cellAt(plan, base, *named)][*method]});
  }
  return out;
}

void measureIn(const std::vector<Placed>& sum, const std::vector<Placed>& divisor, const Plan& plan,
               const Outcome& outcome, Measured& out)
{
  const std::string& metric = sum.front().term->metric;
  if (isRootOfMeans(metric))
  {
    const std::size_t k = *study::metricByName(metric);
    out.value = divisor.empty() ? outcome.summary(plan, sum.front().group, k)
                                : outcome.ratio(plan, sum.front().group, divisor.front().group, k)
                                      .value_or(math::MeanInterval{});
    return;
  }
  const Values values = sumOf(sum, plan, outcome);
  if (divisor.empty())
  {
    out.value = study::statistics(values);
    return;
  }
  const Values by = sumOf(divisor, plan, outcome);
  out.value = study::pairedRatio(values, by).value_or(math::MeanInterval{});
  const math::MeanInterval ofBy = study::statistics(by);
  const bool isNeverBelow =
      std::all_of(by.begin(), by.end(), [](const auto& v) { return v.value_or(0) >= 0; });
  out.isByPositive = isNeverBelow || (ofBy.count > 1 && ofBy.mean > ofBy.halfWidth95);
}

/// What a cell is in the axes that are not named.
std::string openPart(const Plan& plan, const Cell& cell, const Named& named)
{
  std::string out;
  const auto labels = plan.cellLabels(), values = plan.cellValues(cell);
  const std::size_t logs = labels.size() - plan.spec.axes.size();
  for (std::size_t i = 0; i < labels.size(); ++i)
  {
    const auto isIt = [&](const auto& n) { return i >= logs && n.first == i - logs; };
    if (!placeOf(named, isIt)) out += (out.empty() ? "" : ", ") + labels[i] + " " + values[i];
  }
  return out;
}

bool isAt(const Cell& cell, const Named& named)
{
  return std::all_of(named.begin(), named.end(),
                     [&](const auto& n) { return cell.values[n.first] == n.second; });
}
}  // namespace

bool isRootOfMeans(const std::string& metric)
{
  const auto k = study::metricByName(metric);
  return k && study::metrics()[*k].numerator != nullptr;
}

std::string labelOf(const std::string& metric)
{
  if (metric == kCpuTime) return "CPU time of a run [s]";
  return study::metrics()[*study::metricByName(metric)].label;
}

int decimalsOf(const std::string& metric)
{
  return metric == kCpuTime ? 3 : study::metrics()[*study::metricByName(metric)].decimals;
}

std::vector<Measured> measure(const Condition& condition, const Plan& plan, const Outcome& outcome)
{
  const auto named = namedIn(condition.sum.front(), plan);
  if (!named) return {};
  std::vector<Measured> out;
  for (std::size_t c = 0; c < plan.cells.size(); ++c)
  {
    if (!isAt(plan.cells[c], *named)) continue;
    const auto sum = place(condition.sum, plan, c), divisor = place(condition.divisor, plan, c);
    if (!sum || !divisor) return {};
    Measured& m = out.emplace_back();
    m.cell = openPart(plan, plan.cells[c], *named);
    m.seeds = plan.spec.seeds;
    measureIn(*sum, *divisor, plan, outcome, m);
  }
  return out;
}
}  // namespace slamot::reproduce
