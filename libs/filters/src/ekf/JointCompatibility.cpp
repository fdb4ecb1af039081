#include "JointCompatibility.h"

#include <slamot/math/statistics.h>

#include <limits>

namespace slamot::filters::ekf
{
namespace
{
Matrix2 across(const Belief& belief, const SightingRows& a, const SightingRows& b)
{
  const LowerMatrix& P = belief.P();
  Matrix2 out = a.byRobot * P.block<3, 3>(a.robot, b.robot) * b.byRobot.transpose();
  out += a.byRobot * P.block<3, 2>(a.robot, b.object) * b.byObject.transpose();
  out += a.byObject * P.block<2, 3>(a.object, b.robot) * b.byRobot.transpose();
  out += a.byObject * P.block<2, 2>(a.object, b.object) * b.byObject.transpose();
  return out;
}

class Search
{
 public:
  Search(const Belief& belief, const std::vector<PossiblePair>& pairs, double probability, int most)
      : pairs_(pairs), steps_(most)
  {
    const auto n = static_cast<Eigen::Index>(pairs.size());
    S_.resize(2 * n, 2 * n);
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index j = 0; j <= i; ++j)
        S_.block<2, 2>(2 * i, 2 * j) = across(belief, pairs[at(i)].rows, pairs[at(j)].rows);
    for (std::size_t i = 0; i < pairs.size(); ++i)
    {
      if (i == 0 || pairs[i].sighting != pairs[i - 1].sighting) begin_.push_back(i);
      const SightingRows& rows = pairs[i].rows;
      S_.diagonal().segment<2>(static_cast<Eigen::Index>(2 * i)) += rows.factor * rows.variance;
    }
    const std::size_t sightings = begin_.size();
    begin_.push_back(pairs.size());
    for (std::size_t k = 0; k <= sightings; ++k)
      gate_.push_back(k == 0 ? 0 : math::chiSquareQuantile(probability, 2.0 * double(k)));
    const auto m = static_cast<Eigen::Index>(2 * sightings);
    L_.setZero(m, m);
    y_.setZero(m);
  }

  std::vector<int> best()
  {
    descend(0, 0);
    return best_;
  }

 private:
  static std::size_t at(Eigen::Index i) { return static_cast<std::size_t>(i); }

  void descend(std::size_t level, double d2)
  {
    const std::size_t left = begin_.size() - 1 - level;
    const std::size_t reach = chosen_.size() + left;
    if (reach < best_.size() || (reach == best_.size() && d2 >= bestD2_) || --steps_ < 0) return;
    // A larger set may be within its gate where a part of it is not within its own.
    if (d2 > gate_[reach]) return;
    if (left == 0)
    {
      best_ = chosen_;
      bestD2_ = d2;
      return;
    }
    for (std::size_t i = begin_[level]; i < begin_[level + 1]; ++i)
    {
      if (isTaken(pairs_[i].thing)) continue;
      const double with = d2 + append(static_cast<int>(i));
      chosen_.push_back(static_cast<int>(i));
      descend(level + 1, with);
      chosen_.pop_back();
    }
    descend(level + 1, d2);
  }

  [[nodiscard]] bool isTaken(int thing) const
  {
    return std::any_of(chosen_.begin(), chosen_.end(),
                       [&](int c) { return pairs_[static_cast<std::size_t>(c)].thing == thing; });
  }

  /// Two more rows of the Cholesky factor of the chosen pairs' S; what they add to the distance.
  double append(int pair)
  {
    const auto k = static_cast<Eigen::Index>(2 * chosen_.size());
    const Eigen::Index row = 2 * Eigen::Index{pair};
    Eigen::Matrix<double, Eigen::Dynamic, 2> c(k, 2);  // S between the chosen pairs and this one
    for (Eigen::Index i = 0; i < k; i += 2)
      c.middleRows<2>(i) = S_.block<2, 2>(row, 2 * Eigen::Index{chosen_[at(i / 2)]}).transpose();
    const auto L = L_.topLeftCorner(k, k).triangularView<Eigen::Lower>();
    L.solveInPlace(c);
    Matrix2 own = S_.block<2, 2>(row, row) - c.transpose() * c;
    const double a = std::sqrt(own(0, 0)), b = own(1, 0) / a, d = std::sqrt(own(1, 1) - b * b);
    L_.block(k, 0, 2, k) = c.transpose();
    L_.block<2, 2>(k, k) << a, 0, b, d;
    const Vector2 nu =
        pairs_[static_cast<std::size_t>(pair)].rows.innovation - c.transpose() * y_.head(k);
    y_.segment<2>(k) << nu[0] / a, (nu[1] - b * nu[0] / a) / d;
    return y_.segment<2>(k).squaredNorm();
  }

  const std::vector<PossiblePair>& pairs_;
  int steps_;
  std::vector<std::size_t> begin_;  // of each sighting's pairs
  std::vector<double> gate_;        // by the number of pairs
  Eigen::MatrixXd S_, L_;
  Eigen::VectorXd y_;
  std::vector<int> chosen_, best_;
  double bestD2_ = std::numeric_limits<double>::infinity();
};
}  // namespace

std::vector<int> jointlyCompatible(const Belief& belief, const std::vector<PossiblePair>& pairs,
                                   double probability, int most)
{
  if (pairs.empty()) return {};
  return Search(belief, pairs, probability, most).best();
}
}  // namespace slamot::filters::ekf
