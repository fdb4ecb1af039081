#pragma once

#include <mrpt/system/datetime.h>

#include <cmath>
#include <optional>

namespace slamot::mrpt
{
/// MRPT counts 100 ns ticks from 1601; this many lie before the Unix epoch.
inline constexpr std::int64_t kTicksBefore1970 = 116444736000000000;
inline constexpr double kTicksPerSecond = 1e7;  ///< of 100 ns

/// Seconds since the Unix epoch; a time of at most seven decimals comes back exactly.
[[nodiscard]] inline ::mrpt::system::TTimeStamp toTimestamp(double seconds)
{
  return ::mrpt::system::TTimeStamp(
      ::mrpt::Clock::duration(std::llround(seconds * kTicksPerSecond) + kTicksBefore1970));
}

/// None for INVALID_TIMESTAMP, which is 0, and for times before 1601 or after the year 9999.
[[nodiscard]] inline std::optional<double> toSeconds(::mrpt::system::TTimeStamp t)
{
  constexpr std::int64_t kEnd = 2650467744000000000;
  const std::int64_t ticks = t.time_since_epoch().count();
  if (ticks <= 0 || ticks >= kEnd) return std::nullopt;
  return static_cast<double>(ticks - kTicksBefore1970) / kTicksPerSecond;
}
}  // namespace slamot::mrpt
