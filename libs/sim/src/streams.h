#pragma once

#include <slamot/math/random.h>

namespace slamot::sim
{
/// What random numbers are for.  Each purpose, step and object has its own stream, so that adding a
/// landmark or a target, or changing the sensing, leaves all other draws as they were.
enum class Purpose : std::uint64_t
{
  kLandmark,
  kStart,
  kStartKnowledge,
  kManoeuvre,
  kMotion,
  kLandmarkSensing,
  kLandmarkClutter,
  kTargetSensing,
  kTargetClutter,
  kMateSensing,
  kMateClutter,
  kBoundStart,
  kLaser,
  kCamera
};

/// A robot's place among the objects, and what it adds to those it senses and knows of.  Targets
/// lie at id + 1, between robots 0 and 1.
[[nodiscard]] inline std::uint64_t robotKey(int robot)
{
  return static_cast<std::uint64_t>(robot) << 32;
}
[[nodiscard]] inline std::uint64_t targetKey(int id)
{
  return static_cast<std::uint64_t>(id) + 1;
}

[[nodiscard]] inline math::RandomStream stream(std::uint64_t seed, Purpose purpose,
                                               std::uint64_t step, std::uint64_t object)
{
  return {seed, static_cast<std::uint64_t>(purpose), step, object};
}
}  // namespace slamot::sim
