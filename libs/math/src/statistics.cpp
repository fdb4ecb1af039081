#include <slamot/math/statistics.h>

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace slamot::math
{
double chiSquareQuantile(double probability, double dof)
{
  if (!(probability > 0 && probability < 1 && dof > 0))
    throw std::domain_error("chi-square quantile needs 0 < probability < 1 and dof > 0");
  return boost::math::quantile(boost::math::chi_squared(dof), probability);
}

MeanInterval meanInterval(const std::vector<double>& values)
{
  MeanInterval out;
  out.count = static_cast<int>(values.size());
  if (values.empty()) return {std::numeric_limits<double>::quiet_NaN(), 0, 0, 0};
  for (const double v : values) out.mean += v / out.count;
  if (out.count < 2) return out;
  double sum = 0;
  for (const double v : values) sum += (v - out.mean) * (v - out.mean);
  out.std = std::sqrt(sum / (out.count - 1));
  const boost::math::students_t t(out.count - 1);
  out.halfWidth95 = boost::math::quantile(t, 0.975) * out.std / std::sqrt(double(out.count));
  return out;
}

double quantile(std::vector<double> values, double q)
{
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  const double at = q * static_cast<double>(values.size() - 1);
  const auto low = static_cast<std::size_t>(at);
  if (low + 1 >= values.size()) return values.back();
  return values[low] + (at - static_cast<double>(low)) * (values[low + 1] - values[low]);
}
}  // namespace slamot::math
