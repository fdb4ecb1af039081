#pragma once

#include <slamot/core/Step.h>

namespace slamot::core
{
/// What every filter demands of a step before it touches its state: time not before `lastTime`, all
/// values finite, deviations positive, odometry's covariance symmetric and without a negative
/// eigenvalue.  \throws Error (kNonsense) naming the time and what is wrong.
void checkStep(const Step& step, double lastTime);
}  // namespace slamot::core
