#include <slamot/models/NoiseLaw.h>

#include <slamot/math/statistics.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace slamot::models
{
namespace
{
// Parts of the outliers, from the smallest factors to the largest, each to become one Gaussian:
// chosen by what they leave of the exact densities.
const std::vector<double>& partsOf(NoiseLaw::Tail tail)
{
  static const std::vector<double> student{1, 0.6, 0.3, 0.12, 0.04, 0.01, 0.002, 0};
  static const std::vector<double> laplace{1, 0.95, 0.8, 0.5, 0.2, 0.05, 0.005, 0};
  static const std::vector<double> gaussian{1, 0};
  return tail == NoiseLaw::Tail::kStudent   ? student
         : tail == NoiseLaw::Tail::kLaplace ? laplace
                                            : gaussian;
}
}  // namespace

NoiseLaw::NoiseLaw(const Settings& settings) : settings_(settings)
{
  if (!(settings.probability >= 0 && settings.probability <= 1 && settings.scale > 0 &&
        settings.freedom > 0))
    throw std::domain_error("a law of noise wants a probability, a scale and a freedom above 0");
  if (settings.probability < 1) components_.push_back({1 - settings.probability, 1});
  const std::vector<double>& parts = partsOf(settings.tail);
  for (std::size_t k = 0; settings.probability > 0 && k + 1 < parts.size(); ++k)
  {
    constexpr int kPoints = 200;
    double sum = 0;  // of logarithms: the middle of a part by ratios
    for (int i = 0; i < kPoints; ++i)
      sum += std::log(outlierFactor(parts[k] + (parts[k + 1] - parts[k]) * (i + 0.5) / kPoints));
    components_.push_back(
        {settings.probability * (parts[k] - parts[k + 1]), std::exp(sum / kPoints)});
  }
  std::sort(components_.begin(), components_.end(),
            [](const Component& a, const Component& b) { return a.factor < b.factor; });
  for (const Component& c : components_) meanFactor_ += c.weight * c.factor;
}

std::shared_ptr<const NoiseLaw> NoiseLaw::from(core::Params& p, const std::string& prefix,
                                               double otherwise)
{
  Settings s{};
  s.probability = p.inRange(prefix + "glint_probability", 0, 1, otherwise);
  const std::string law =
      p.choice(prefix + "glint_law", {"student-t", "gaussian", "laplace"}, "student-t");
  s.tail = law == "student-t"  ? Tail::kStudent
           : law == "gaussian" ? Tail::kGaussian
                               : Tail::kLaplace;
  s.scale = p.inRange(prefix + "glint_scale", 0.01, 1000, 3.0);
  s.freedom = p.inRange(prefix + "glint_freedom", 0.5, 1000, 2.0);
  return s.probability > 0 ? std::make_shared<NoiseLaw>(s) : nullptr;
}

double NoiseLaw::drawFactor(math::RandomStream& random) const
{
  const bool isOutlier = random.uniform() < settings_.probability;
  return isOutlier ? outlierFactor(1 - random.uniform()) : 1;
}

double NoiseLaw::outlierFactor(double survival) const
{
  constexpr double kEnd = 1e-12;
  const double u = std::clamp(survival, kEnd, 1 - kEnd), square = settings_.scale * settings_.scale;
  switch (settings_.tail)
  {
    case Tail::kStudent:  // the variance's inverse is chi-square over its freedom
      return square * settings_.freedom / math::chiSquareQuantile(u, settings_.freedom);
    case Tail::kLaplace:  // the variance is exponential
      return -square * std::log(u);
    default:
      return square;
  }
}
}  // namespace slamot::models
