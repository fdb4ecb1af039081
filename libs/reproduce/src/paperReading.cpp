#include "paperReading.h"

#include <slamot/core/Error.h>
#include <slamot/study/Metrics.h>

#include <algorithm>
#include <stdexcept>

#include "measured.h"

namespace slamot::reproduce
{
namespace
{
const study::Axis* axisOf(const study::StudySpec& spec, const std::string& name)
{
  for (const study::Axis& axis : spec.axes)
    if (axis.name == name) return &axis;
  return nullptr;
}

bool hasMethod(const study::StudySpec& spec, const std::string& name)
{
  return std::any_of(spec.methods.begin(), spec.methods.end(),
                     [&](const study::Method& m) { return m.name == name; });
}

bool hasValue(const study::StudySpec& spec, const std::string& axis, const std::string& value)
{
  const study::Axis* a = axisOf(spec, axis);
  return a && std::find(a->values.begin(), a->values.end(), value) != a->values.end();
}

std::string methodsOf(const study::StudySpec& spec)
{
  std::string out;
  for (const study::Method& m : spec.methods) out += (out.empty() ? "" : ", ") + m.name;
  return out;
}

void checkMethod(core::Params& p, const std::string& key, const std::string& method,
                 const Studies& studies)
{
  if (hasMethod(studies.asFiled, method) || hasMethod(studies.asRun, method)) return;
  p.fail(key, "'" + method + "' is no method of " + studies.asFiled.name,
         "known: " + methodsOf(studies.asFiled));
}

void checkValue(core::Params& p, const std::string& key, const std::string& axis,
                const std::string& value, const Studies& studies)
{
  if (!axisOf(studies.asFiled, axis) && !axisOf(studies.asRun, axis))
    p.fail(key, "'" + axis + "' is not varied in " + studies.asFiled.name, "name another axis");
  if (!hasValue(studies.asFiled, axis, value) && !hasValue(studies.asRun, axis, value))
    p.fail(key, "axis " + axis + " of " + studies.asFiled.name + " has no value '" + value + "'",
           "write one as tables show it");
}

void checkTerm(core::Params& p, const std::string& key, const Term& term, const Studies& studies)
{
  if (term.metric != kCpuTime && !study::metricByName(term.metric))
    p.fail(key, "'" + term.metric + "' is no metric", "slamot study names all of them");
  checkMethod(p, key, term.method, studies);
  for (const auto& [axis, value] : term.cell) checkValue(p, key, axis, value, studies);
}

/// Ratios to a bound are of mean squares over seeds: no seed has a part of its own in them.
void checkRoots(core::Params& p, const std::string& key, const Condition& condition)
{
  const auto isRoot = [](const Term& t) { return isRootOfMeans(t.metric); };
  const auto any = [&](const auto& sum) { return std::any_of(sum.begin(), sum.end(), isRoot); };
  if (!any(condition.sum) && !any(condition.divisor)) return;
  const bool isPlain = condition.sum.size() == 1 && condition.divisor.empty();
  const bool isRatio = condition.sum.size() == 1 && condition.divisor.size() == 1 &&
                       condition.sum[0].metric == condition.divisor[0].metric;
  if (!isPlain && !isRatio)
    p.fail(key, "a ratio to a bound can't be added to, or divided by, another metric",
           "compare it by itself, or with the same of another method");
}

/// Open axes have to be the same in all terms: each value is one check.
void checkOpenAxes(core::Params& p, const std::string& key, const Condition& condition,
                   const study::StudySpec& spec)
{
  std::vector<const Term*> terms;
  for (const Term& t : condition.sum) terms.push_back(&t);
  for (const Term& t : condition.divisor) terms.push_back(&t);
  for (const study::Axis& axis : spec.axes)
  {
    const auto names = [&](const Term* t) { return t->cell.count(axis.name) > 0; };
    const auto count = std::count_if(terms.begin(), terms.end(), names);
    if (count != 0 && static_cast<std::size_t>(count) != terms.size())
      p.fail(key, "only some of its terms name a value of " + axis.name, "name it in all, or none");
  }
}

Claim::Part readPart(core::Params& p, const std::string& key, const Studies& studies)
{
  Claim::Part out;
  try
  {
    out.condition = parseCondition(p.text(key));
  }
  catch (const std::invalid_argument& e)
  {
    p.fail(key, e.what(), "write one as robot_mean_m(a) / robot_mean_m(b) < 1");
  }
  for (const auto* sum : {&out.condition.sum, &out.condition.divisor})
    for (const Term& term : *sum) checkTerm(p, key, term, studies);
  checkRoots(p, key, out.condition);
  checkOpenAxes(p, key, out.condition, studies.asRun);
  out.label = p.text("what." + key.substr(5), "");
  return out;
}

Claim readClaim(core::Config& paper, const std::string& name, const Studies* studies)
{
  core::Params p(paper, "claim." + name);
  Claim out;
  out.name = name;
  out.says = p.text("says");
  out.where = p.text("where", "");
  out.note = p.text("note", "");
  out.untestable = p.text("untestable", "");
  std::vector<std::string> conditions;
  for (const std::string& key : p.keys())
    if (key.rfind("when.", 0) == 0) conditions.push_back(key);
  if (conditions.empty() == out.untestable.empty())
    p.fail("untestable", conditions.empty() ? "missing" : "is given beside conditions",
           "give conditions when.1, when.2, ... or the reason why it can't be tested");
  if (!conditions.empty() && !studies)
    p.fail(conditions.front(), "its section has no study", "name one there");
  for (const std::string& key : conditions) out.parts.push_back(readPart(p, key, *studies));
  return out;
}

Picture::Kind kindOf(const std::string& name)
{
  if (name == "scans") return Picture::Kind::kScans;
  if (name == "robot-errors") return Picture::Kind::kRobotErrors;
  if (name == "target-errors") return Picture::Kind::kTargetErrors;
  if (name == "nees") return Picture::Kind::kNees;
  return Picture::Kind::kMap;
}

Picture readPicture(core::Config& paper, const std::string& name, const Studies& studies)
{
  core::Params p(paper, "picture." + name);
  Picture out;
  out.name = name;
  out.kind = kindOf(p.choice("kind", {"map", "scans", "robot-errors", "target-errors", "nees"}));
  out.caption = p.text("caption");
  out.method = p.text("method");
  checkMethod(p, "method", out.method, studies);
  out.seed = static_cast<std::uint64_t>(p.integer("seed", 0, std::numeric_limits<int>::max(), 1));
  for (const auto* spec : {&studies.asFiled, &studies.asRun})
    for (const study::Axis& axis : spec->axes)
      if (p.has(axis.name)) out.cell[axis.name] = p.text(axis.name);
  for (const auto& [axis, value] : out.cell) checkValue(p, axis, axis, value, studies);
  return out;
}
}  // namespace

std::vector<Claim> readClaims(core::Config& paper, core::Params& section,
                              const std::vector<std::string>& names, const Studies* studies)
{
  std::vector<Claim> out;
  for (const std::string& name : names)
  {
    if (!paper.has("claim." + name))
      section.fail("claims", "there is no [claim." + name + "]", "add it");
    out.push_back(readClaim(paper, name, studies));
  }
  return out;
}

std::vector<Picture> readPictures(core::Config& paper, core::Params& section,
                                  const std::vector<std::string>& names, const Studies& studies)
{
  std::vector<Picture> out;
  for (const std::string& name : names)
  {
    if (!paper.has("picture." + name))
      section.fail("pictures", "there is no [picture." + name + "]", "add it");
    out.push_back(readPicture(paper, name, studies));
  }
  return out;
}
}  // namespace slamot::reproduce
