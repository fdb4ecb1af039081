#include <slamot/study/ErrorCurves.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "metricEntries.h"

namespace slamot::study
{
namespace
{
/// Sums over the parts of a run's time.
class Sums
{
 public:
  Sums(const eval::Record& record, std::size_t parts)
      : record_(&record), sums_(parts), counts_(parts)
  {
  }

  template <class Size>
  void add(const std::vector<eval::StepError>& steps, Size&& size)
  {
    for (const eval::StepError& s : steps)
    {
      const std::optional<double> value = size(s);
      if (!value) continue;
      const std::size_t part = partOf(s.row);
      sums_[part] += *value;
      ++counts_[part];
    }
  }

  [[nodiscard]] std::vector<std::optional<double>> means() const
  {
    std::vector<std::optional<double>> out(sums_.size());
    for (std::size_t i = 0; i < out.size(); ++i)
      if (counts_[i] > 0) out[i] = sums_[i] / counts_[i];
    return out;
  }

 private:
  [[nodiscard]] std::size_t partOf(std::size_t row) const
  {
    const auto& rows = record_->rows;
    const double span = rows.back().time - rows.front().time;
    if (span <= 0) return 0;
    const double share = (rows[row].time - rows.front().time) / span;
    const auto part = static_cast<std::size_t>(share * static_cast<double>(sums_.size()));
    return std::min(part, sums_.size() - 1);
  }

  const eval::Record* record_;
  std::vector<double> sums_;
  std::vector<int> counts_;
};

std::optional<double> headingSize(const eval::StepError& s)
{
  if (!s.headingKnown) return std::nullopt;
  return std::abs(s.error[2]);
}

using Values = std::vector<std::optional<double>>;

/// A run's own curves: robot position and heading, target position and heading.
std::vector<Values> ownCurves(const eval::Record& record, const eval::Evaluation& evaluation,
                              std::size_t parts)
{
  std::vector<Sums> sums(4, Sums(record, parts));
  sums[0].add(evaluation.robot.steps, distance);
  sums[1].add(evaluation.robot.steps, headingSize);
  for (const eval::TargetEvaluation& t : evaluation.trueTargets)
  {
    sums[2].add(t.steps, distance);
    sums[3].add(t.steps, headingSize);
  }
  std::vector<Values> out;
  for (const Sums& s : sums) out.push_back(s.means());
  return out;
}

constexpr const char* kWhat[] = {"robot_position_m", "robot_heading_rad", "target_position_m",
                                 "target_heading_rad"};

bool isEmpty(const Values& values)
{
  return std::none_of(values.begin(), values.end(), [](const auto& v) { return v.has_value(); });
}

/// `robot<number>_...` in its two parts; none if it is no such name.
std::optional<std::pair<std::string, std::string>> splitNumbered(const std::string& name)
{
  const auto bar = name.find('_');
  if (name.rfind("robot", 0) != 0 || bar == std::string::npos || bar == 5) return std::nullopt;
  const std::string number = name.substr(5, bar - 5);
  const auto isDigit = [](unsigned char c) { return std::isdigit(c) != 0; };
  if (!std::all_of(number.begin(), number.end(), isDigit)) return std::nullopt;
  return std::make_pair(number, "robot" + name.substr(bar));
}
}  // namespace

const ErrorCurves::Curve* ErrorCurves::named(const std::string& name) const
{
  const auto it =
      std::find_if(curves.begin(), curves.end(), [&](const Curve& c) { return c.name == name; });
  return it == curves.end() ? nullptr : &*it;
}

ErrorCurves errorCurves(const std::vector<eval::RunWithTruth>& runs,
                        const std::vector<eval::Evaluation>& evaluations, int parts)
{
  ErrorCurves out;
  const auto count = static_cast<std::size_t>(parts);
  std::vector<std::vector<Values>> robots;
  for (std::size_t r = 0; r < runs.size(); ++r)
  {
    const auto& rows = runs[r].record->rows;
    if (rows.empty()) return out;
    out.durationS = std::max(out.durationS, rows.back().time - rows.front().time);
    robots.push_back(ownCurves(*runs[r].record, evaluations[r], count));
  }
  const auto add = [&](const std::string& name, Values values)
  {
    if (!isEmpty(values)) out.curves.push_back({name, std::move(values)});
  };
  for (std::size_t c = 0; c < std::size(kWhat); ++c)
  {
    std::vector<Values> each;
    for (const auto& robot : robots) each.push_back(robot[c]);
    add(kWhat[c], presentMeans(each));
  }
  for (std::size_t r = 0; robots.size() > 1 && r < robots.size(); ++r)
    for (std::size_t c = 0; c < 2; ++c)
      add("robot" + std::to_string(r) + std::string(kWhat[c]).substr(5), robots[r][c]);
  return out;
}

bool isCurveName(const std::string& name)
{
  const auto numbered = splitNumbered(name);
  const std::string plain = numbered ? numbered->second : name;
  return std::find(std::begin(kWhat), std::end(kWhat), plain) != std::end(kWhat);
}

std::string curveLabel(const std::string& name)
{
  const auto numbered = splitNumbered(name);
  const std::string plain = numbered ? numbered->second : name;
  const std::string who = plain.substr(0, plain.find('_'));
  const bool isHeading = plain.find("heading") != std::string::npos;
  return who + (numbered ? " " + numbered->first : "") +
         (isHeading ? " heading error [rad]" : " position error [m]");
}
}  // namespace slamot::study
