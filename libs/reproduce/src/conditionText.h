#pragma once

#include <slamot/reproduce/judge.h>
#include <slamot/study/Plan.h>

#include "measured.h"

namespace slamot::reproduce
{
/// Half of the interval that holds the mean of so many more runs, 95% of the time.
[[nodiscard]] double predictionHalf(const math::MeanInterval& value, int runs);

/// What a condition measures, in words: its own label, or what its terms say.
[[nodiscard]] std::string wordsOf(const Claim::Part& part, const study::Plan& plan);

/// "0.0420 ± 0.0045", and of how many runs if not all have it
[[nodiscard]] std::string measuredText(const Measured& measured, const Condition& condition);

/// "below 1", "as published: 0.0393 (0.0136)", ...
[[nodiscard]] std::string claimedText(const Condition& condition);

/// How far a number is off a published one, and which way; or why nothing can be decided.
[[nodiscard]] std::string remarkOf(const Measured& measured, const Condition& condition,
                                   Status status);
}  // namespace slamot::reproduce
