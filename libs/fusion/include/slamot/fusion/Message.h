#pragma once

#include <slamot/core/Team.h>
#include <slamot/fusion/Outcome.h>

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace slamot::fusion
{
using Bytes = std::vector<std::uint8_t>;  ///< a message on the wire

inline constexpr int kAll = -1;             ///< receiver of a message that is for everybody
inline constexpr int kMaxCandidates = 16;   ///< keeps a message within one Ethernet frame
inline constexpr int kMaxFrameLength = 32;  ///< characters of the frame's name

/// Something that the sender saw and can't explain: false, or a team mate.  From the sender's
/// frame.
struct Candidate
{
  double range = 0;       ///< [m]
  double bearing = 0;     ///< [rad]
  double rangeStd = 0;    ///< [m]
  double bearingStd = 0;  ///< [rad]
  int id = core::kNoId;   ///< identity of the team mate, if the sensor tells
};

/// What one robot tells the others: of fixed size, whatever its map.
struct Message
{
  int sender = 0;                 ///< its robot's number
  int receiver = kAll;            ///< the number of the robot that it is for
  std::uint64_t session = 0;      ///< higher after each start of the sender, such as its clock then
  std::uint64_t sequence = 0;     ///< rises within a session
  std::string frame;              ///< name of the map frame that all robots share
  core::RobotAndTarget estimate;  ///< at estimate.time; covariance symmetric
  std::vector<Candidate> candidates;  ///< seen at estimate.time
};

/// The message in bytes: little endian, layout version 1 in doc/team.md.
/// \throws core::Error (kConfig) if sizes are none a message can have, or the frame's name is too
/// long or holds a zero.
[[nodiscard]] Bytes encode(const Message& message);

/// The message, or why it is none.  Never throws; values are as sent, whatever they are.
[[nodiscard]] std::variant<Message, Outcome> decode(const Bytes& bytes);

/// Bytes that a message takes.
[[nodiscard]] std::size_t encodedSize(int coordinates, int candidates);

/// CRC-32 (IEEE 802.3) of all but the last four bytes, where a message keeps it.
[[nodiscard]] std::uint32_t checksum(const Bytes& bytes);
}  // namespace slamot::fusion
