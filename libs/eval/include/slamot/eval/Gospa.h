#pragma once

#include <slamot/math/geometry.h>

#include <utility>
#include <vector>

namespace slamot::eval
{
/// Generalised optimal sub-pattern assignment metric with alpha = 2 and p = 2.  Rahmathullah,
/// García-Fernández, Svensson, "Generalized optimal sub-pattern assignment metric", 2017, prop. 1.
struct Gospa
{
  std::size_t estimated = 0;  ///< points estimated
  std::size_t truly = 0;      ///< points that are there
  double total = 0;           ///< [m]: sqrt of the sum of the three
  double localisation = 0;    ///< [m²]: squared distances of the pairs
  double missed = 0;          ///< [m²]: c²/2 for each true point without an estimate
  double falseOnes = 0;       ///< [m²]: c²/2 for each estimate without a true point
  /// Places in (estimates, truths), in rising order of the first; no pair is c or more apart.
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  /// [m]: the optimal sub-pattern assignment metric of order 2, which the same pairs make least; 0
  /// for two empty sets, c if just one is.  Schuhmacher, Vo, Vo, "A consistent metric for
  /// performance evaluation of multi-object filters", 2008, eq. 3.
  double ospa = 0;
};

/// Exact.  Its cost is that of the largest group of points that steps shorter than c join, not of
/// the sets.  \param c cut-off [m], > 0.  \throws std::domain_error for a point that is not finite.
[[nodiscard]] Gospa gospa(const std::vector<Point2D>& estimates, const std::vector<Point2D>& truths,
                          double c);
}  // namespace slamot::eval
