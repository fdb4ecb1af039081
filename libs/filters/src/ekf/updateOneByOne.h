#pragma once

#include "Belief.h"

namespace slamot::filters::ekf
{
/// What a scan's sightings do to x and P, with W = P Hᵀ: x + W gain, P - W reduction Wᵀ.
struct LawUpdate
{
  Eigen::VectorXd gain;
  Eigen::MatrixXd reduction;  ///< symmetric, and not always positive: glint can leave more doubt
  double logDensity = 0;      ///< of the innovations
};

/// The update by sightings whose errors have laws, one after another, each judged for glint by what
/// the ones before it left: the one that fits best first.  All of it happens among what is expected
/// of the sightings, with covariance C = H P Hᵀ, whatever the size of P.  See soften().
[[nodiscard]] LawUpdate updateOneByOne(const std::vector<SightingRows>& rows, Eigen::MatrixXd C);
}  // namespace slamot::filters::ekf
