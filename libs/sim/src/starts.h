#pragma once

#include "streams.h"

#include <slamot/core/Start.h>
#include <slamot/sim/Scenario.h>

namespace slamot::sim
{
/// Standard deviation of a place that nobody tells [m].
inline constexpr double kUnknownPlace = 1e3;

/// Where everything is at the start; equal seeds place landmark n alike whatever their number.
/// \throws core::Error (kConfig) if the landmarks' keys, or the robot's distance from its
/// target, leave no place in the area.
[[nodiscard]] std::map<int, Point2D> placeLandmarks(const Scenario& scenario, std::uint64_t seed);
[[nodiscard]] std::map<int, Pose2D> placeTargets(const Scenario& scenario, std::uint64_t seed);
[[nodiscard]] Pose2D placeRobot(const Scenario& scenario, int robot,
                                const std::map<int, Pose2D>& targets, std::uint64_t seed);

/// What a filter is told of an object's start: the truth with an error.
[[nodiscard]] core::ObjectStart knownStart(const StartKnowledge& knowledge, const Motion& motion,
                                           const Pose2D& truth, math::RandomStream random);
}  // namespace slamot::sim
