#include "Settings.h"

namespace slamot::filters::rbpf
{
Settings Settings::from(core::Params& p)
{
  using PF = ::mrpt::bayes::CParticleFilter;
  Settings s{};
  static_cast<TargetSettings&>(s) = TargetSettings::from(p);
  s.particles = p.integer("particles", 1, 1000000);
  s.informed = p.choice("proposal", {"motion", "informed"}) == "informed";
  s.knownIds = p.choice("association", {"known", "nn"}) == "known";
  s.newDensity = p.nonNegative("new_density_per_m_rad", 0.0);
  static_cast<LandmarkNoise&>(s) = LandmarkNoise::from(p);
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

}  // namespace slamot::filters::rbpf
