#pragma once

#include <slamot/live/Network.h>

#include <optional>

namespace slamot::live
{
/// What a robot tells twice a second: that it is there, and what time it is in its log.
struct Beacon
{
  int sender = 0;               ///< its robot's number
  std::uint64_t session = 0;    ///< higher after each start of the sender
  double speed = 1;             ///< of the log's clock against the wall's
  std::optional<double> clock;  ///< time in the log [s]; absent: it waits for the team
  bool hearsAll = false;        ///< it has heard all others of the team
};

/// Little endian, layout in doc/team.md.
[[nodiscard]] Bytes encode(const Beacon& beacon);
/// Absent if the bytes are no beacon, or a number in it is not finite.
[[nodiscard]] std::optional<Beacon> decodeBeacon(const Bytes& bytes);
}  // namespace slamot::live
