#pragma once

#include "Sighting.h"

namespace slamot::filters
{
/// Takes into an innovation that its sighting may glint: that its error is of a sum of Gaussians
/// w_k N(0, f_k R), see models::NoiseLaw.  Given S_k = S + (f_k - 1) R and the Gaussians' shares
/// mu_k of the innovation's density, the update by all of them together has mean P Hᵀ M nu and
/// covariance P - P Hᵀ (M - E) H P with M = sum mu_k S_k⁻¹ and E the covariance of S_k⁻¹ nu over
/// the shares: a multiple-model step whose models have no memory, since outliers have none
/// (Bar-Shalom, Li, Kirubarajan 2001, section 11.6.4, the generalized pseudo-Bayesian estimator of
/// first order).
///
/// S becomes M⁻¹, the e's E, and d2 gets an excess such that -(d2 + ln |S|) / 2 is the logarithm of
/// the law's own density, without its factor of 2 pi: gates, costs and weights go on as with one
/// Gaussian.
/// \param noise what multiplied the sighting's variances.
/// \param poseCov of a pose still to be sampled, whose doubt is not in S: what it explains is no
/// glint. Null: none.
void softenByLaw(const Ray& z, double noise, const Matrix3* poseCov, Innovation& o);
inline void soften(const Ray& z, double noise, const Matrix3* poseCov, Innovation& o)
{
  if (z.law) softenByLaw(z, noise, poseCov, o);
}

/// Ray::reach: by how much farther than that of a normal error, squared, the distance is where d2
/// passes `gate` (over range and bearing).
[[nodiscard]] double reachOf(const models::NoiseLaw& law, double gate);
}  // namespace slamot::filters
