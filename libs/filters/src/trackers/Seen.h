#pragma once

#include "sighting/Targets.h"

namespace slamot::filters::trackers
{
/// A blob as an observation: of range and bearing, or of a place.
struct Seen
{
  Ray ray;
  bool isPlace;  ///< as metres along the ray and across it

  Seen(const Ray& r, bool asPlace) : ray(r), isPlace(asPlace && r.hasRange)
  {
    if (isPlace) ray.varBearing *= ray.range * ray.range;
  }

  /// The ray as the sensor told it.
  [[nodiscard]] Ray polar() const
  {
    Ray out = ray;
    if (isPlace) out.varBearing /= out.range * out.range;
    return out;
  }
};

/// Of a place that an observation tells, by a target's: linear in the target's place.  Its
/// coordinates are metres along the ray and across it, to the left.
inline Innovation innovatePlace(const Eye& eye, const Ray& z, double mx, double my, double pxx,
                                double pxy, double pyy)
{
  const double c = eye.c * z.cosB - eye.s * z.sinB, s = eye.s * z.cosB + eye.c * z.sinB;
  const double dx = mx - eye.x, dy = my - eye.y;
  Innovation o{};
  o.nuR = z.range - (c * dx + s * dy);
  o.nuB = s * dx - c * dy;
  o.h11 = c;
  o.h12 = s;
  o.h21 = -s;
  o.h22 = c;
  o.s11 = c * c * pxx + 2 * c * s * pxy + s * s * pyy + z.varRange;
  o.s12 = c * s * (pyy - pxx) + (c * c - s * s) * pxy;
  o.s22 = s * s * pxx - 2 * c * s * pxy + c * c * pyy + z.varBearing;
  o.det = o.s11 * o.s22 - o.s12 * o.s12;
  o.d2 = o.form();
  o.factor = 1;
  return o;
}

/// Innovation of an observation of a target, by its law; false where it has none.
template <class State>
bool innovateSeen(const Eye& eye, const Seen& z, const State& t, Innovation& o)
{
  if (!z.isPlace) return innovateTarget(eye, z.ray, t, o);
  o = innovatePlace(eye, z.ray, t.x[0], t.x[1], t.P(0, 0), t.P(0, 1), t.P(1, 1));
  soften(z.ray, 1, nullptr, o);
  return true;
}
}  // namespace slamot::filters::trackers
