#include "LawScore.h"

#include <cmath>

namespace slamot::sim
{
namespace
{
/// Of a Gaussian of so many coordinates at squared size q, but for its constant.
double density(const models::NoiseLaw::Component& c, int size, double q)
{
  return c.weight * std::exp(-0.5 * q / c.factor) / (size == 2 ? c.factor : std::sqrt(c.factor));
}
}  // namespace

LawScore::LawScore(std::shared_ptr<const models::NoiseLaw> law, int size)
    : law_(std::move(law)), size_(size)
{
  // E[g² q] / size over the size r of the error, by the trapezium rule over its logarithm.
  constexpr double kRatio = 1.005;
  const double most = 10 * std::sqrt(law_->widest());
  double sum = 0, all = 0;
  for (double r = 1e-7; r < most; r *= kRatio)
  {
    double p = 0;
    for (const auto& c : law_->components()) p += density(c, size, r * r);
    p *= size == 2 ? r * r : r;  // of the logarithm: once more by r
    sum += p * std::pow(inverseFactor(r * r) * r, 2) / size;
    all += p;
  }
  information_ = sum / all;
}

double LawScore::inverseFactor(double q) const
{
  // By the widest, which is the last to vanish: far out all others are nothing.
  const auto& components = law_->components();
  const auto& widest = components.back();
  double sum = 0, all = 0;
  for (const auto& c : components)
  {
    const double power = -0.5 * q * (1 / c.factor - 1 / widest.factor);
    const double ratio = widest.factor / c.factor;
    const double p = c.weight * std::exp(power) * (size_ == 2 ? ratio : std::sqrt(ratio));
    sum += p / c.factor;
    all += p;
  }
  return sum / all;
}
}  // namespace slamot::sim
