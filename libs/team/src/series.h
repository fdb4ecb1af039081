#pragma once

#include <slamot/results/Plot.h>

#include <limits>
#include <string>

namespace slamot::team
{
/// One without points yet.
inline results::Series series(results::Series::Kind kind, const std::string& title,
                              results::Ink ink)
{
  return {kind, title, ink, {}, {}, {}, {}};
}

/// Adds a point.
inline void append(results::Series& s, double x, double y)
{
  s.x.push_back(x);
  s.y.push_back(y);
}

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();  // breaks a line
}  // namespace slamot::team
