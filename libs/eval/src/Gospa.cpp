#include <slamot/eval/Gospa.h>
#include <slamot/math/assignment.h>

#include <algorithm>
#include <cmath>

#include "groups.h"

namespace slamot::eval
{
namespace
{
/// Of one group: adds its pairs and their squared distances.
void pairGroup(const std::vector<Point2D>& estimates, const std::vector<Point2D>& truths,
               const Group& group, double c2, Gospa& out)
{
  // A pair at the cut-off costs c², as much as leaving both alone: so pairs may be forced.
  Eigen::MatrixXd cost(group.first.size(), group.second.size());
  for (std::size_t i = 0; i < group.first.size(); ++i)
    for (std::size_t j = 0; j < group.second.size(); ++j)
      cost(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          std::min((estimates[group.first[i]] - truths[group.second[j]]).sqrNorm(), c2);
  const std::vector<int> truthOf = math::assign(cost);
  for (std::size_t i = 0; i < truthOf.size(); ++i)
  {
    if (truthOf[i] < 0) continue;
    const double d2 = cost(static_cast<Eigen::Index>(i), truthOf[i]);
    if (d2 >= c2) continue;
    out.localisation += d2;
    out.pairs.emplace_back(group.first[i], group.second[static_cast<std::size_t>(truthOf[i])]);
  }
}
}  // namespace

Gospa gospa(const std::vector<Point2D>& estimates, const std::vector<Point2D>& truths, double c)
{
  Gospa out;
  out.estimated = estimates.size();
  out.truly = truths.size();
  for (const Group& group : groupsWithin(c, estimates, truths))
    pairGroup(estimates, truths, group, c * c, out);
  std::sort(out.pairs.begin(), out.pairs.end());
  const auto paired = static_cast<double>(out.pairs.size());
  const double alone = c * c / 2;
  out.missed = alone * (static_cast<double>(truths.size()) - paired);
  out.falseOnes = alone * (static_cast<double>(estimates.size()) - paired);
  out.total = std::sqrt(out.localisation + out.missed + out.falseOnes);
  // Both metrics want the least sum of d² - c² over the pairs.
  const auto larger = static_cast<double>(std::max(estimates.size(), truths.size()));
  if (larger > 0) out.ospa = std::sqrt((out.localisation + c * c * (larger - paired)) / larger);
  return out;
}
}  // namespace slamot::eval
