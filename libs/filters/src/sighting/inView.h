#pragma once

#include "Sighting.h"

namespace slamot::filters
{
/// The part of N(0, 1) below t.
inline double normalBelow(double t)
{
  if (t > 4) return 1;
  if (t < -4) return 0;
  return 0.5 * std::erfc(-t * 0.70710678118654752);
}

/// The chance that something is in a field of view whose range [m] and bearing [rad] from there
/// have these deviations.
inline double partInView(const core::FieldOfView& fov, double range, double bearing,
                         double rangeStd, double bearingStd)
{
  double in = normalBelow((fov.rangeMax - range) / rangeStd);
  if (in <= 0) return 0;
  if (fov.rangeMin > 0) in *= normalBelow((range - fov.rangeMin) / rangeStd);
  if (fov.bearingMax - fov.bearingMin < math::kTwoPi - 1e-6)
    in *= normalBelow((bearing - fov.bearingMin) / bearingStd) *
          normalBelow((fov.bearingMax - bearing) / bearingStd);
  return in;
}

/// How much of a thing at (x, y) is in a field of view: soft at the edges, where it may be seen or
/// not.
/// \param var largest variance of its place along any axis, plus that of a range [m²].
/// \param bearingVar of a sighting [rad²].
inline double partInView(const core::FieldOfView& fov, const Eye& eye, double x, double y,
                         double var, double bearingVar)
{
  const double dx = x - eye.x, dy = y - eye.y, r = std::hypot(dx, dy), std = std::sqrt(var);
  if (fov.rangeMax + 4 * std < r) return 0;
  const double turn = std::max(std / std::max(r, std), std::sqrt(bearingVar));
  return partInView(fov, r, math::wrapToPi(std::atan2(dy, dx) - eye.phi), std, turn);
}
}  // namespace slamot::filters
