#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace slamot::reproduce
{
/// A number of a study's runs: `metric(method, axis=value, ...)`.  An axis that is not named stands
/// for each of its values in turn.
struct Term
{
  std::string metric;  ///< as study::metrics() names them, or cpu_s: the CPU time of a run [s]
  std::string method;  ///< of the study, by its name
  std::map<std::string, std::string> cell;  ///< axes by name, values as shown
  bool isTakenAway = false;                 ///< follows a minus sign
};

/// What a number is held against.
struct Bound
{
  /// How the number and the bound are compared.
  enum class Kind
  {
    kBelow,            ///< `< high`
    kAbove,            ///< `> low`
    kBetween,          ///< `in low .. high`
    kAsPublished,      ///< `= published`
    kAtMostPublished,  ///< `<= published`
    kAtLeastPublished  ///< `>= published`
  };
  Kind kind = Kind::kBelow;         ///< which of these
  double low = 0;                   ///< of kAbove and kBetween
  double high = 0;                  ///< of kBelow and kBetween
  double published = 0;             ///< of the others: the mean that the paper gives
  std::optional<double> deviation;  ///< `+- deviation`, as published: of its runs
  std::optional<int> runs;          ///< `of runs runs`: that it is a mean of
};

/// One thing that has to be so if a claim holds: `sum / sum bound`, the divisor optional.
///
///     target_late_mean_m(motion) / target_early_mean_m(motion) < 1
///     robot_mean_m(motion, particles=50) = 0.0393 +- 0.0136
///     (a(x) - b(x)) / (a(y) - b(y)) in 0.9 .. 1.1
struct Condition
{
  std::vector<Term> sum;      ///< never empty
  std::vector<Term> divisor;  ///< empty: the sum itself is looked at
  Bound bound;                ///< what the number must meet
  std::string text;           ///< as written
};

/// \throws std::invalid_argument saying what is wrong with it.
[[nodiscard]] Condition parseCondition(const std::string& text);
}  // namespace slamot::reproduce
