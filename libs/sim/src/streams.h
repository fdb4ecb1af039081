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
  kTargetClutter
};

/// The robot's place among the objects; targets follow at id + 1.
inline constexpr std::uint64_t kRobot = 0;
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
