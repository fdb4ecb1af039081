#pragma once

#include <slamot/live/Network.h>

#include <optional>

namespace slamot::live
{
/// What a robot in lockstep tells of each of its steps, all of it to all.
struct Announcement
{
  /// What it is an announcement of.
  enum class Kind : std::uint8_t
  {
    kHello,  ///< before the first step
    kStep,   ///< a step was taken in; what others say of it was not yet
    kLeft    ///< the robot ends before its log does
  };
  Kind kind = Kind::kHello;    ///< which of these
  int sender = 0;              ///< its robot's number
  std::uint64_t session = 0;   ///< higher after each start of the sender
  std::uint64_t sequence = 0;  ///< from 0 on, by one
  double time = 0;             ///< of the step [s]
  double next = 0;             ///< of the step after it [s]; infinite at the log's end
  Bytes message;               ///< what the robot tells of its estimate; empty: nothing this time
};

/// Little endian, layout in doc/team.md.
[[nodiscard]] Bytes encode(const Announcement& announcement);
/// Absent if the bytes are no announcement.
[[nodiscard]] std::optional<Announcement> decodeAnnouncement(const Bytes& bytes);
}  // namespace slamot::live
