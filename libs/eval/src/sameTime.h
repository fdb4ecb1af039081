#pragma once

namespace slamot::eval
{
/// Times that differ by no more are one [s]: they come from ticks of 100 ns on one side and from text
/// on the other.
constexpr double kSameTime = 2e-6;
}  // namespace slamot::eval
