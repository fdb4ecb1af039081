#pragma once

#include "SightingTracks.h"
#include "sighting/SensorSettings.h"

#include <mrpt/bayes/CParticleFilter.h>

namespace slamot::filters::rbpf
{
/// The keys of section [rbpf-slamot] (and of [independent]) but for the target's motion.
struct Settings : TargetSettings, LandmarkNoise
{
  int particles;
  bool informed;      ///< proposal = informed, not motion
  bool knownIds;      ///< association = known, not nn
  double newDensity;  ///< p_new [1/(m rad)]; 0: that of a pair at the inner gate's edge
  SightingTracks::Settings tracking;  ///< nn: what follows a post from scan to scan
  int confirmSightings;               ///< landmarks seen less often are not reported
  double detection;                   ///< chance to see a landmark in view; 0: misses tell nothing
  ::mrpt::bayes::CParticleFilter::TParticleFilterOptions resampling;

  static Settings from(core::Params& p);
  using LandmarkNoise::ray;
  using TargetSettings::ray;
};
}  // namespace slamot::filters::rbpf
