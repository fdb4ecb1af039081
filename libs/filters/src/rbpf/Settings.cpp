#include "Settings.h"

#include "resampling.h"

#include <slamot/math/statistics.h>

namespace slamot::filters::rbpf
{
namespace
{
/// The choice made, by its place in the list.
template <class Enum>
Enum chosen(core::Params& p, const std::string& key, const std::vector<std::string>& names,
            const std::optional<std::string>& otherwise)
{
  const std::string name = p.choice(key, names, otherwise);
  return static_cast<Enum>(std::find(names.begin(), names.end(), name) - names.begin());
}

IntensitySettings readIntensity(core::Params& p, double detection)
{
  IntensitySettings s{};
  // Within a squared distance U, a Gaussian's own points lie with a chance of 1 - exp(-U/2).  One
  // miss leaves more of a sure component than makes it no feature.
  static_cast<MixtureSettings&>(s) =
      MixtureSettings::from(p, "", {0.01, 1e-4, 4, 0.1 * 0.1, 20000, 0.5, 0.25 * (1 - detection)});
  s.weight = chosen<IntensityWeight>(p, "particle_weight",
                                     {"cluster", "single-feature", "empty-set"}, "cluster");
  return s;
}

std::optional<TargetSetSettings> readTargetSet(core::Params& p)
{
  p.allowUnused(MixtureSettings::keys("target_"));
  p.allowUnused({"target_survival", "target_detection_probability", "target_clutter_per_scan"});
  if (p.choice("targets", {"tracks", "gm-phd"}, "tracks") == "tracks") return {};
  TargetSetSettings s{};
  s.survival = p.inRange("target_survival", 1e-6, 1, 0.99);
  s.detection = p.inRange("target_detection_probability", 1e-6, 0.999, 0.95);
  s.clutter = p.positive("target_clutter_per_scan", 0.1);
  // A target stays though two misses in a row leave little of its weight, since it is more likely
  // there than not; so that it must be all but sure before it is one.
  static_cast<MixtureSettings&>(s) = MixtureSettings::from(
      p, "target_", {0.01, 1e-4, 4, 0.05 * 0.05, 100, 0.9, 0.25 * std::pow(1 - s.detection, 2)});
  return s;
}

void checkTogether(const core::Params& p, const Settings& s)
{
  if ((s.tracking.rangeStd > 0) != (s.tracking.bearingStd > 0))
    p.fail("follow_bearing_std_deg", "and follow_range_std_m go together",
           "set both above 0, or neither");
  if (s.intensity && s.isKnown())
    p.fail("association", "known is not for map = gm-phd, which pairs nothing", "choose nn");
  if (s.intensity && s.marginalWeight)
    p.fail("weight", "marginal is not for map = gm-phd", "set sampled");
  if (s.intensity && !(s.detection > 0 && s.clutter > 0))
    p.fail(s.clutter > 0 ? "detection_probability" : "clutter_per_scan",
           "must be above 0 for map = gm-phd");
  if (s.sequential && s.marginalWeight)
    p.fail("weight", "marginal is not for proposal_update = sequential", "set sampled");
}
}  // namespace

MixtureSettings MixtureSettings::from(core::Params& p, const std::string& prefix,
                                      const MixtureSettings& otherwise)
{
  MixtureSettings s{};
  s.birthWeight = p.positive(prefix + "birth_weight", otherwise.birthWeight);
  s.pruneWeight = p.positive(prefix + "prune_weight", otherwise.pruneWeight);
  s.mergeDistance2 = p.positive(prefix + "merge_distance2", otherwise.mergeDistance2);
  s.floorVar =
      std::pow(p.nonNegative(prefix + "merge_floor_std_m", std::sqrt(otherwise.floorVar)), 2);
  s.mostComponents = p.integer(prefix + "most_components", 1, 1000000, otherwise.mostComponents);
  s.confirm = p.positive(prefix + "confirm_weight", otherwise.confirm);
  s.unconfirm = p.positive(prefix + "unconfirm_weight", otherwise.unconfirm);
  if (s.unconfirm >= s.confirm)
    p.fail(prefix + "unconfirm_weight", "is not below " + prefix + "confirm_weight",
           "make it smaller");
  return s;
}

std::vector<std::string> MixtureSettings::keys(const std::string& prefix)
{
  std::vector<std::string> out;
  for (const char* key : {"birth_weight", "prune_weight", "merge_distance2", "merge_floor_std_m",
                          "most_components", "confirm_weight", "unconfirm_weight"})
    out.push_back(prefix + key);
  return out;
}

Settings Settings::from(core::Params& p, const Preset& preset)
{
  Settings s{};
  static_cast<TargetSettings&>(s) = TargetSettings::from(p);
  s.particles = p.integer("particles", 1, 1000000, preset.particles);
  s.proposal =
      chosen<Proposal>(p, "proposal", {"motion", "informed", "unscented"}, preset.proposal);
  s.unscentedMap = p.choice("map_update", {"ekf", "unscented"}, preset.mapUpdate) == "unscented";
  s.sequential = p.choice("proposal_update", {"batch", "sequential"}, "batch") == "sequential";
  const bool intensity = p.choice("map", {"landmarks", "gm-phd"}, preset.map) == "gm-phd";
  s.marginalWeight = p.choice("weight", {"marginal", "sampled"}, preset.weight) == "marginal";
  s.weightExponent = p.inRange("weight_exponent", 0, 1, 1.0);
  s.association = chosen<Association>(p, "association", {"known", "nn", "scnn", "jcbb", "jml"},
                                      preset.association);
  s.gateProbability = p.probability("gate_probability", 0.99);
  s.newDensity = p.nonNegative("new_density_per_m_rad", 0.0);
  static_cast<LandmarkNoise&>(s) = LandmarkNoise::from(p, s.gates.outer);
  if (s.association == Association::kNearest && !intensity)
    s.tracking = {p.nonNegative("follow_range_std_m", 0.0),
                  p.nonNegative("follow_bearing_std_deg", 0.0)};
  s.confirmSightings = p.integer("confirm_sightings", 1, 1000000, s.isKnown() || intensity ? 1 : 3);
  s.detection = p.inRange("detection_probability", 0, 0.999, intensity ? 0.95 : 0.0);
  s.clutter = p.nonNegative("clutter_per_scan", intensity ? 0.1 : 0.0);
  // Known, so that --set can change the kind of map.
  p.allowUnused(MixtureSettings::keys(""));
  p.allowUnused({"particle_weight"});
  if (intensity) s.intensity = readIntensity(p, s.detection);
  s.targetSet = readTargetSet(p);
  checkTogether(p, s);
  s.resampling = resamplingFrom(p, s.particles);
  if (s.isInformed()) s.resampling.PF_algorithm = ::mrpt::bayes::CParticleFilter::pfOptimalProposal;
  return s;
}
}  // namespace slamot::filters::rbpf
