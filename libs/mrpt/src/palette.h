#pragma once

#include <mrpt/img/TColor.h>

#include <array>

namespace slamot::mrpt
{
using Colour = ::mrpt::img::TColor;

// The colours of the report's plots.
inline const Colour kRobot(0x00, 0x72, 0xb2), kLandmark(0x00, 0x9e, 0x73), kTruth(0x24, 0x29, 0x2f);
inline const Colour kFaint(0xad, 0xb5, 0xbd), kLaser(0x8c, 0x95, 0x9f), kParticle(0x56, 0xb4, 0xe9);
inline const Colour kScan(0xcf, 0x22, 0x2e), kSighting(0x7f, 0xce, 0xb9);
inline const std::array<Colour, 5> kTargets{Colour(0xd5, 0x5e, 0x00), Colour(0xb0, 0x57, 0x8d),
                                            Colour(0xe6, 0x9f, 0x00), Colour(0x56, 0xb4, 0xe9),
                                            Colour(0x00, 0x9e, 0x73)};

// Of a team's robots; the landmarks' green is not among them.
inline const std::array<Colour, 5> kTeam{kRobot, kTargets[0], kTargets[1], kTargets[2],
                                         kTargets[3]};

[[nodiscard]] inline const Colour& targetColour(std::size_t i)
{
  return kTargets[i % kTargets.size()];
}
[[nodiscard]] inline const Colour& teamColour(std::size_t i)
{
  return kTeam[i % kTeam.size()];
}
}  // namespace slamot::mrpt
