#include "Settings.h"

#include <slamot/math/statistics.h>

#include <algorithm>

namespace slamot::filters::rbpf
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
          p.nonNegative("target_bearing_std_deg", 0.0)};
}

Settings Settings::from(core::Params& p)
{
  using PF = ::mrpt::bayes::CParticleFilter;
  Settings s{};
  static_cast<TargetSettings&>(s) = TargetSettings::from(p);
  s.particles = p.integer("particles", 1, 1000000);
  s.informed = p.choice("proposal", {"motion", "informed"}) == "informed";
  s.knownIds = p.choice("association", {"known", "nn"}) == "known";
  s.newDensity = p.nonNegative("new_density_per_m_rad", 0.0);
  s.rangeStd = p.nonNegative("range_std_m", 0.0);
  s.bearingStd = p.nonNegative("bearing_std_deg", 0.0);
  s.correlationTime = p.nonNegative("sighting_correlation_s", 0.0);
  if (!s.knownIds)
    s.tracking = {p.nonNegative("follow_range_std_m", 0.0),
                  p.nonNegative("follow_bearing_std_deg", 0.0)};
  if ((s.tracking.rangeStd > 0) != (s.tracking.bearingStd > 0))
    p.fail("follow_bearing_std_deg", "and follow_range_std_m go together",
           "set both above 0, or neither");
  s.confirmSightings = p.integer("confirm_sightings", 1, 1000000, s.knownIds ? 1 : 3);
  s.detection = p.inRange("detection_probability", 0, 0.999, 0.0);
  s.resampling.BETA = p.inRange("resample_below_ess", 0, 1, 0.5);
  const std::string scheme =
      p.choice("resampling", {"systematic", "stratified", "residual", "multinomial"}, "systematic");
  s.resampling.resamplingMethod = scheme == "systematic"   ? PF::prSystematic
                                  : scheme == "stratified" ? PF::prStratified
                                  : scheme == "residual"   ? PF::prResidual
                                                           : PF::prMultinomial;
  s.resampling.PF_algorithm = s.informed ? PF::pfOptimalProposal : PF::pfStandardProposal;
  s.resampling.adaptiveSampleSize = false;
  s.resampling.sampleSize = static_cast<unsigned>(s.particles);
  return s;
}

double Settings::noiseAfter(double pause) const
{
  constexpr double kMost = 1000;
  return std::clamp(correlationTime / std::max(pause, 1e-9), 1.0, kMost);
}

Ray Settings::ray(const core::Sighting& s) const
{
  return Ray::of(s.range, s.bearing, rangeStd > 0 ? rangeStd : s.rangeStd,
                 bearingStd > 0 ? bearingStd : s.bearingStd);
}

Ray TargetSettings::ray(const core::Blob& b) const
{
  const double bStd = targetBearingStd > 0 ? targetBearingStd : b.bearingStd;
  if (!b.range) return Ray::ofBearing(b.bearing, bStd);
  return Ray::of(*b.range, b.bearing, targetRangeStd > 0 ? targetRangeStd : b.rangeStd, bStd);
}
}  // namespace slamot::filters::rbpf
