#include "Settings.h"

namespace slamot::filters::ekf
{
Settings Settings::from(core::Params& p)
{
  Settings s{};
  static_cast<TargetSettings&>(s) = TargetSettings::from(p);
  static_cast<LandmarkNoise&>(s) = LandmarkNoise::from(p);
  const std::string a = p.choice("association", {"known", "nn", "jcbb"}, "known");
  s.association = a == "known" ? Association::kKnown
                  : a == "nn"  ? Association::kNearest
                               : Association::kJoint;
  s.gateProbability = p.probability("gate_probability", 0.99);
  const bool known = s.association == Association::kKnown;
  s.confirmSightings = p.integer("confirm_sightings", 1, 1000000, known ? 1 : 3);
  s.tentativeTime = p.positive("landmark_tentative_s", 30.0);
  s.firstEstimates = p.flag("first_estimates", false);
  s.localRadius = p.nonNegative("local_radius_m", 0.0);
  return s;
}
}  // namespace slamot::filters::ekf
