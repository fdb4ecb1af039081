#include "SensorSettings.h"

#include "soften.h"

#include <slamot/math/statistics.h>

#include <algorithm>

namespace slamot::filters
{
Gates Gates::from(core::Params& p)
{
  const double inner = p.probability("gate_probability", 0.99);
  const double outer = p.probability("new_gate_probability", 0.99999);
  if (outer < inner)
    p.fail("new_gate_probability", "is below gate_probability", "make it the larger");
  return {math::chiSquareQuantile(inner, 2), math::chiSquareQuantile(outer, 2),
          math::chiSquareQuantile(inner, 1), math::chiSquareQuantile(outer, 1)};
}

TargetSettings TargetSettings::from(core::Params& p)
{
  return {Gates::from(p), TrackRules::from(p), p.nonNegative("target_range_std_m", 0.0),
          p.nonNegative("target_bearing_std_deg", 0.0), models::NoiseLaw::from(p, "target_")};
}

Ray TargetSettings::ray(const core::Blob& b) const
{
  const double bStd = targetBearingStd > 0 ? targetBearingStd : b.bearingStd;
  const double rStd = targetRangeStd > 0 ? targetRangeStd : b.rangeStd;
  Ray out = b.range ? Ray::of(*b.range, b.bearing, rStd, bStd) : Ray::ofBearing(b.bearing, bStd);
  out.law = targetLaw.get();
  return out;
}

LandmarkNoise LandmarkNoise::from(core::Params& p, double gate)
{
  LandmarkNoise out{p.nonNegative("range_std_m", 0.0), p.nonNegative("bearing_std_deg", 0.0),
                    p.nonNegative("sighting_correlation_s", 0.0), models::NoiseLaw::from(p, "")};
  if (out.law) out.reach = reachOf(*out.law, gate);
  return out;
}

Ray LandmarkNoise::ray(const core::Sighting& s) const
{
  Ray out = Ray::of(s.range, s.bearing, rangeStd > 0 ? rangeStd : s.rangeStd,
                    bearingStd > 0 ? bearingStd : s.bearingStd);
  out.law = law.get();
  out.reach = reach;
  return out;
}

double LandmarkNoise::noiseAfter(double pause) const
{
  constexpr double kMost = 1000;
  return std::clamp(correlationTime / std::max(pause, 1e-9), 1.0, kMost);
}
}  // namespace slamot::filters
