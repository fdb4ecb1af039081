#pragma once

#include <vector>

namespace slamot::math
{
/// The value below which a chi-square variable of `dof` degrees stays with this probability.
/// \throws std::domain_error unless 0 < probability < 1 and dof > 0.
[[nodiscard]] double chiSquareQuantile(double probability, double dof);

/// Mean with the half width of its 95% interval (Student t; 0 for fewer than two values).
struct MeanInterval
{
  double mean = 0;         ///< arithmetic; NaN of no values
  double halfWidth95 = 0;  ///< mean ± this holds the true mean in 95 of 100 samples
  double std = 0;          ///< of single values, with n - 1
  int count = 0;           ///< of values
};
/// Student's interval of values that are independent and about normal.
[[nodiscard]] MeanInterval meanInterval(const std::vector<double>& values);

/// The q-quantile (0 to 1) by linear interpolation; NaN if there are no values.
[[nodiscard]] double quantile(std::vector<double> values, double q);
}  // namespace slamot::math
