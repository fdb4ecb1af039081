#pragma once

#include "boxBeams.h"

namespace slamot::moving
{
/// The box after a scan: the most probable one, by Gauss-Newton from the prediction, residuals
/// weighed down beyond two deviations (Huber); its covariance the inverse of the last information.
/// The iterated extended Kalman filter of Bell and Cathey, 1993, for a view whose faces change with
/// the state.
[[nodiscard]] BoxState correct(const BoxState& predicted, const BoxView& view,
                               const MovingOptions& options);
}  // namespace slamot::moving
