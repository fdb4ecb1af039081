#pragma once

#include <slamot/models/NoiseLaw.h>

namespace slamot::sim
{
/// What an error w of a law tells of the place that it is an error about, by what one of N(0, R)
/// would: the score is -R⁻¹ w inverseFactor(wᵀ R⁻¹ w), and its covariance, the law's Fisher
/// information, is information() R⁻¹.
class LawScore
{
 public:
  /// \param size coordinates of w: 1 or 2.
  LawScore(std::shared_ptr<const models::NoiseLaw> law, int size);

  [[nodiscard]] double information() const { return information_; }
  /// The mean of 1 / factor over the Gaussians that an error of squared size q may be of.
  [[nodiscard]] double inverseFactor(double q) const;

 private:
  std::shared_ptr<const models::NoiseLaw> law_;
  int size_;
  double information_ = 1;
};
}  // namespace slamot::sim
