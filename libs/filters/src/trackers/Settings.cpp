#include "Settings.h"

namespace slamot::filters::trackers
{
Settings Settings::from(core::Params& p, double glint)
{
  Settings s{};
  static_cast<TargetSettings&>(s) = TargetSettings::from(p);
  s.targetLaw = models::NoiseLaw::from(p, "target_", glint);
  if (p.choice("likelihood", {"glint", "gaussian"}, "glint") == "gaussian") s.targetLaw = nullptr;
  s.known = p.choice("association", {"known", "nn"}, "nn") == "known";
  s.places = p.choice("observation", {"polar", "position"}, "polar") == "position";
  s.noiseScale = p.inRange("noise_scale", 1e-6, 1e6, 1.0);
  return s;
}

Seen Settings::seen(const core::Blob& blob) const
{
  Ray ray = TargetSettings::ray(blob);
  if (ray.hasRange) ray.varRange *= noiseScale * noiseScale;
  ray.varBearing *= noiseScale * noiseScale;
  return {ray, places};
}
}  // namespace slamot::filters::trackers
