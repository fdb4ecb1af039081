#pragma once

#include <slamot/core/Params.h>

#include <string>
#include <vector>

namespace slamot::dds
{
/// Section [dds] of a configuration: the network of a live team.
struct DdsOptions
{
  std::vector<int> team;  ///< numbers of all robots, in the order of [team] methods
  int domain = 0;         ///< of DDS; also its ports
  std::string name;       ///< robots of another name are not heard, in the same domain either
  std::string interface;  ///< name or address of the network interface; empty: Cyclone DDS chooses
  /// Hosts of the others, for networks without multicast; empty: they are found by multicast.
  std::vector<std::string> peers;
  std::string security;   ///< folder of this robot's keys; empty: no DDS Security
  double packetLoss = 0;  ///< part of its packets that this robot throws away, to try that out
  double silenceS = 60;   ///< [s]: in lockstep, who is silent for so long is given up

  /// \throws core::Error (kConfig).
  static DdsOptions from(core::Config& config);
};

/// The options in the form that Cyclone DDS takes.
[[nodiscard]] std::string cycloneConfig(const DdsOptions& options);
}  // namespace slamot::dds
