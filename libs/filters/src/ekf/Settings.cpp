#include "Settings.h"

namespace slamot::filters::ekf
{
namespace
{
std::optional<ArrivalSettings> readArrival(core::Params& p, bool several)
{
  // Known, so that --set can change the association.
  p.allowUnused({"hypotheses", "least_hypothesis", "merge_distance2", "detection_probability",
                 "clutter_per_scan", "new_per_scan"});
  if (!several) return {};
  ArrivalSettings s{};
  s.most = p.integer("hypotheses", 1, 1000, 10);
  s.least = p.inRange("least_hypothesis", 1e-12, 1, 1e-2);
  s.merge = p.nonNegative("merge_distance2", 0.1);
  s.detection = p.inRange("detection_probability", 1e-6, 0.999, 0.95);
  s.clutter = p.positive("clutter_per_scan", 0.1);
  s.arrivals = p.positive("new_per_scan", 0.1);
  return s;
}
}  // namespace

Settings Settings::from(core::Params& p, const Preset& preset)
{
  Settings s{};
  static_cast<TargetSettings&>(s) = TargetSettings::from(p);
  static_cast<LandmarkNoise&>(s) = LandmarkNoise::from(p, s.gates.outer);
  const std::string a = p.choice("association", {"known", "nn", "jcbb", "mht"}, preset.association);
  s.association = a == "known"  ? Association::kKnown
                  : a == "nn"   ? Association::kNearest
                  : a == "jcbb" ? Association::kJoint
                                : Association::kSeveral;
  s.gateProbability = p.probability("gate_probability", 0.99);
  const bool known = s.association == Association::kKnown;
  s.arrival = readArrival(p, s.association == Association::kSeveral);
  s.confirmSightings = p.integer("confirm_sightings", 1, 1000000, known ? 1 : s.arrival ? 2 : 3);
  s.tentativeTime = p.positive("landmark_tentative_s", s.arrival ? 2.0 : 30.0);
  s.firstEstimates = p.flag("first_estimates", preset.firstEstimates);
  s.localRadius = p.nonNegative("local_radius_m", 0.0);
  return s;
}
}  // namespace slamot::filters::ekf
