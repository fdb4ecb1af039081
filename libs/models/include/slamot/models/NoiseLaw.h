#pragma once

#include <slamot/core/Params.h>
#include <slamot/math/random.h>

#include <memory>
#include <vector>

namespace slamot::models
{
/// The law of a sensor's errors w where now and then one is an outlier ("glint"): with covariance R
/// of an ordinary error, p(w) = (1 - epsilon) N(w; 0, R) + epsilon t(w), where t has the contours
/// of N(0, scale² R) and the tails of a choice: Student's, a Gaussian's, or Laplace's.  Zhu and Jin
/// 2018.
///
/// Each of these tails is a Gaussian whose variance is itself random, the same for all coordinates
/// of an error: so the law is kept as a sum of Gaussians N(0, factor R), with which every Kalman
/// update and likelihood can work.  Within 15% of the exact density out to 50 scales (Student's, 2
/// degrees of freedom) and to 5 (Laplace's).
class NoiseLaw
{
 public:
  /// How outliers are spread.
  enum class Tail
  {
    kStudent,   ///< Student's t: a power of the distance
    kGaussian,  ///< one wider Gaussian
    kLaplace    ///< exponential in the distance
  };
  /// What a law is made of.
  struct Settings
  {
    double probability;  ///< epsilon
    Tail tail;           ///< of the outliers
    double scale;        ///< of the outliers' deviations by those of ordinary errors
    double freedom;      ///< Student's degrees of freedom
  };
  /// A Gaussian of the sum: N(0, factor R).
  struct Component
  {
    double weight;  ///< share of the errors
    double factor;  ///< of R
  };

  /// \throws std::domain_error unless 0 <= probability <= 1, scale > 0 and freedom > 0.
  explicit NoiseLaw(const Settings& settings);
  /// From the keys `glint_probability`, `glint_law`, `glint_scale` and `glint_freedom`.
  /// \param p the section. \param prefix of the keys.
  /// \param otherwise the probability where the configuration tells none.
  /// \return null where there is no glint.
  static std::shared_ptr<const NoiseLaw> from(core::Params& p, const std::string& prefix,
                                              double otherwise = 0);

  /// As it was made.
  [[nodiscard]] const Settings& settings() const { return settings_; }
  /// By rising factors; the weights' sum is 1.
  [[nodiscard]] const std::vector<Component>& components() const { return components_; }
  /// The largest factor: beyond a gate of that there is nothing.
  [[nodiscard]] double widest() const { return components_.back().factor; }
  /// The mean factor: of the covariance of an error of which nothing tells whether it glints.
  [[nodiscard]] double meanFactor() const { return meanFactor_; }
  /// What multiplies R for one error, drawn from the exact law.
  [[nodiscard]] double drawFactor(math::RandomStream& random) const;

 private:
  /// The factor that a part `survival` of the outliers exceeds.
  [[nodiscard]] double outlierFactor(double survival) const;

  Settings settings_;
  std::vector<Component> components_;
  double meanFactor_ = 0;
};
}  // namespace slamot::models
