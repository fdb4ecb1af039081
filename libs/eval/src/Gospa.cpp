#include <slamot/eval/Gospa.h>
#include <slamot/math/assignment.h>

#include <algorithm>
#include <cmath>

namespace slamot::eval
{
namespace
{
Eigen::MatrixXd cutSquaredDistances(const std::vector<Point2D>& a, const std::vector<Point2D>& b,
                                    double c)
{
  Eigen::MatrixXd cost(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j)
      cost(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          std::min((a[i] - b[j]).sqrNorm(), c * c);
  return cost;
}
}  // namespace

Gospa gospa(const std::vector<Point2D>& estimates, const std::vector<Point2D>& truths, double c)
{
  Gospa out;
  // A pair at the cut-off costs c², as much as leaving both alone: so pairs may be forced.
  const Eigen::MatrixXd cost = cutSquaredDistances(estimates, truths, c);
  const std::vector<int> truthOf = math::assign(cost);
  for (std::size_t i = 0; i < truthOf.size(); ++i)
  {
    if (truthOf[i] < 0) continue;
    const double d2 = cost(static_cast<Eigen::Index>(i), truthOf[i]);
    if (d2 >= c * c) continue;
    out.localisation += d2;
    out.pairs.emplace_back(i, static_cast<std::size_t>(truthOf[i]));
  }
  const double alone = c * c / 2;
  out.missed = alone * static_cast<double>(truths.size() - out.pairs.size());
  out.falseOnes = alone * static_cast<double>(estimates.size() - out.pairs.size());
  out.total = std::sqrt(out.localisation + out.missed + out.falseOnes);
  return out;
}

double ospa(const std::vector<Point2D>& estimates, const std::vector<Point2D>& truths, double c)
{
  const std::size_t larger = std::max(estimates.size(), truths.size());
  const std::size_t smaller = std::min(estimates.size(), truths.size());
  if (larger == 0) return 0;
  const Eigen::MatrixXd cost = cutSquaredDistances(estimates, truths, c);
  const std::vector<int> truthOf = math::assign(cost);
  double sum = c * c * static_cast<double>(larger - smaller);
  for (std::size_t i = 0; i < truthOf.size(); ++i)
    if (truthOf[i] >= 0) sum += cost(static_cast<Eigen::Index>(i), truthOf[i]);
  return std::sqrt(sum / static_cast<double>(larger));
}
}  // namespace slamot::eval
