#pragma once

#include <slamot/fusion/Radio.h>
#include <slamot/fusion/Receiver.h>

namespace slamot::fusion
{
/// Section [team] of a configuration: what is exchanged, when, and how it is fused.
struct TeamOptions
{
  core::FusionOptions fusion;     ///< rule and weight
  bool centralized = false;       ///< rule = centralized: one EKF over all, no messages
  std::string ruleName;           ///< as in the configuration
  int exchangeEvery = 1;          ///< a robot sends after each so many of its own steps
  int target = 0;                 ///< identity of the target that estimates are exchanged of
  std::string mateLabel;          ///< of blobs that may be team mates
  bool mateIdentities = false;    ///< whether the identities of such blobs are believed
  double mateSpeed = 3;           ///< [m/s], of team mates, about
  std::string frame;              ///< name of the map frame that all robots share
  double candidateGate = 0.99;    ///< chance that a true sighting of the receiver is kept
  double targetGate = 0.999;      ///< chance that a true target is kept
  double maxAge = 1;              ///< [s]: older messages are dropped
  double candidateMaxAge = 0.02;  ///< [s]: older sightings of a robot that moves are left out
  Radio::Options radio;           ///< what is lost and late, as simulated

  /// \throws core::Error (kConfig).
  static TeamOptions from(core::Config& config, std::uint64_t seed);
};
}  // namespace slamot::fusion
