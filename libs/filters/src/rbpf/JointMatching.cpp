#include "JointMatching.h"

#include <slamot/math/statistics.h>

#include <algorithm>
#include <tuple>

namespace slamot::filters::rbpf
{
namespace
{
constexpr double kLogTwoPi = 1.8378770664093453;
}

/// Depth first over sightings, those with the fewest pairs first.
class JointMatching::Search
{
 public:
  Search(const Settings& settings, const std::vector<double>& gates, const Matrix3& root,
         const std::vector<double>& logNew, Scratch& scratch)
      : rule_(settings.association),
        inner_(settings.gates.inner),
        gates_(gates),
        root_(root),
        logNew_(logNew),
        s_(scratch)
  {
  }

  void run()
  {
    const std::size_t n = s_.order.size();
    s_.levels.resize(n + 1);
    s_.levels[0].update = {};
    s_.levels[0].pose = s_.levels[0].update.solve(root_);
    s_.chosen.assign(n, kNew);
    s_.best.assign(n, kNew);
    s_.options.clear();
    left_ = rule_ == Association::kSequential ? 0 : kMostTries;
    descend(0, 0, 0, 0);
  }

 private:
  // Joint distance d2 of `pairs` pairs so far, and `score`: the log likelihood.
  void descend(std::size_t level, int pairs, double d2, double score)
  {
    const std::size_t left = s_.order.size() - level;
    const std::size_t reach = size(pairs) + left;
    if (!isBetter(static_cast<int>(reach), d2, score + s_.mostLeft[level])) return;
    // A larger set may be within its gate where a part of it is not within its own.
    if (rule_ == Association::kJoint && d2 > gates_[reach]) return;
    if (left == 0)
    {
      best_ = {true, pairs, d2, score};
      s_.best = s_.chosen;
      return;
    }
    const std::size_t j = s_.order[level];
    const std::size_t begin = s_.options.size();
    listOptions(level, j);
    const std::size_t end = s_.options.size();
    bool tried = false;
    for (std::size_t i = begin; i < end && (!tried || left_ > 0); ++i)
    {
      const Scratch::Option option = s_.options[i];
      const double with = d2 + option.d2;
      if (rule_ == Association::kSequential && with > gates_[size(pairs) + 1]) continue;
      tried = true;
      s_.chosen[level] = option.pair;
      condition(level, option.pair);
      descend(level + 1, pairs + 1, with, score - 0.5 * option.cost - kLogTwoPi);
    }
    s_.options.resize(begin);
    if (tried && left_ <= 0) return;
    s_.chosen[level] = kNew;
    s_.levels[level + 1] = s_.levels[level];
    descend(level + 1, pairs, d2, score + logNew_[j]);
  }

  static std::size_t size(int n) { return static_cast<std::size_t>(n); }

  /// The sighting's free pairs given the pose so far, cheapest first.
  void listOptions(std::size_t level, std::size_t j)
  {
    const auto& pose = s_.levels[level].pose;
    const Matrix3 cov = pose.root * pose.root.transpose();
    const auto begin = static_cast<std::ptrdiff_t>(s_.options.size());
    left_ -= static_cast<int>(s_.begins[j + 1] - s_.begins[j]);
    for (std::size_t p = s_.begins[j]; p < s_.begins[j + 1]; ++p)
    {
      const PossiblePair& pair = s_.pairs[p];
      if (isTaken(level, pair.thing)) continue;
      if (rule_ == Association::kJoint && pair.d2 > inner_) continue;
      const Innovation now = withPose(shifted(pair.innovation, pose.shift), cov);
      if (rule_ == Association::kSequential && now.d2 > inner_) continue;
      s_.options.push_back({now.d2 + std::log(now.det), now.d2, static_cast<std::int32_t>(p)});
    }
    std::sort(s_.options.begin() + begin, s_.options.end(),
              [](const Scratch::Option& a, const Scratch::Option& b)
              { return std::tie(a.cost, a.pair) < std::tie(b.cost, b.pair); });
  }

  [[nodiscard]] bool isTaken(std::size_t level, std::int32_t thing) const
  {
    for (std::size_t l = 0; l < level; ++l)
      if (s_.chosen[l] >= 0 && s_.pairs[size(s_.chosen[l])].thing == thing) return true;
    return false;
  }

  void condition(std::size_t level, std::int32_t pair)
  {
    auto& next = s_.levels[level + 1];
    next.update = s_.levels[level].update;
    next.update.add(s_.pairs[size(pair)].innovation);
    next.pose = next.update.solve(root_);
  }

  /// Whether this beats the best so far; of a part, with the most that the rest may add.
  [[nodiscard]] bool isBetter(int pairs, double d2, double score) const
  {
    if (!best_.any) return true;
    if (rule_ == Association::kLikelihood) return score > best_.score;
    return pairs > best_.pairs || (pairs == best_.pairs && d2 < best_.d2);
  }
  struct Best
  {
    bool any = false;
    int pairs = 0;
    double d2 = 0, score = 0;
  };

  Association rule_;
  double inner_;
  const std::vector<double>& gates_;
  const Matrix3& root_;
  const std::vector<double>& logNew_;
  Scratch& s_;
  int left_ = 0;  // pairs that may still be looked at
  Best best_;
};

void JointMatching::reserve(std::size_t sightings)
{
  while (gates_.size() <= sightings)
    gates_.push_back(gates_.empty() ? 0.0
                                    : math::chiSquareQuantile(settings_.gateProbability,
                                                              2.0 * double(gates_.size())));
}

void JointMatching::match(const Matrix3& root, const std::vector<double>& logNew, Scratch& s,
                          std::vector<std::int32_t>& matches) const
{
  const std::size_t sightings = logNew.size();
  matches.assign(sightings, kNew);
  s.begins.assign(sightings + 1, 0);
  for (const PossiblePair& p : s.pairs) ++s.begins[static_cast<std::size_t>(p.sighting) + 1];
  for (std::size_t j = 0; j < sightings; ++j) s.begins[j + 1] += s.begins[j];
  s.order.clear();
  for (std::size_t j = 0; j < sightings; ++j)
    if (s.begins[j] < s.begins[j + 1]) s.order.push_back(j);
  // Sightings in order for sequential compatibility, which is defined so; the others find the clear
  // ones more useful first.
  const auto count = [&](std::size_t j) { return s.begins[j + 1] - s.begins[j]; };
  if (settings_.association != Association::kSequential)
    std::stable_sort(s.order.begin(), s.order.end(),
                     [&](std::size_t a, std::size_t b) { return count(a) < count(b); });
  // No pair can be likelier than at the centre of its own S, without the pose's part.
  s.mostLeft.assign(s.order.size() + 1, 0);
  for (std::size_t l = s.order.size(); l-- > 0;)
  {
    double most = logNew[s.order[l]];
    for (std::size_t p = s.begins[s.order[l]]; p < s.begins[s.order[l] + 1]; ++p)
      most = std::max(most, -0.5 * std::log(s.pairs[p].innovation.det) - kLogTwoPi);
    s.mostLeft[l] = s.mostLeft[l + 1] + most;
  }
  Search(settings_, gates_, root, logNew, s).run();
  const bool byLikelihood = settings_.association == Association::kLikelihood;
  for (std::size_t l = 0; l < s.order.size(); ++l)
    matches[s.order[l]] = s.best[l] >= 0 ? s.pairs[static_cast<std::size_t>(s.best[l])].thing
                          : byLikelihood ? kNew
                                         : kRejected;
}
}  // namespace slamot::filters::rbpf
