#pragma once

#include <slamot/results/Plot.h>

#include <array>

namespace slamot::results
{
struct Colour
{
  const char* name;   ///< of the CSS variable, without --ink-
  const char* light;  ///< rrggbb on white
  const char* dark;   ///< rrggbb on near black
};

/// In the order of Ink.
inline constexpr std::array<Colour, 8> kPalette{{{"text", "24292f", "e6edf3"},
                                                 {"muted", "8c959f", "7d8590"},
                                                 {"blue", "0072b2", "4ea8de"},
                                                 {"green", "009e73", "2ec49a"},
                                                 {"vermillion", "d55e00", "ff8a3d"},
                                                 {"purple", "b0578d", "e394c3"},
                                                 {"orange", "e69f00", "f0b840"},
                                                 {"sky", "56b4e9", "8ad0f5"}}};
/// Lines of the grid, and the axes.
inline constexpr Colour kGrid{"grid", "e3e6ea", "2b3138"};
inline constexpr Colour kAxis{"axis", "adb5bd", "545d68"};

inline const Colour& colourOf(Ink ink)
{
  return kPalette[static_cast<std::size_t>(ink)];
}
}  // namespace slamot::results
