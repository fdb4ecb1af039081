#pragma once

#include "SightingTracks.h"
#include "Targets.h"

#include <mrpt/bayes/CParticleFilter.h>

namespace slamot::filters::rbpf
{
/// The keys of a filter that follows targets, but for the target's motion.
struct TargetSettings
{
  Gates gates;
  TrackRules tracks;
  double targetRangeStd;    ///< [m]; 0: what the log says
  double targetBearingStd;  ///< [rad]; 0: what the log says

  static TargetSettings from(core::Params& p);
  [[nodiscard]] Ray ray(const core::Blob& b) const;
};

/// The keys of section [rbpf-slamot] (and of [independent]) but for the target's motion.
struct Settings : TargetSettings
{
  int particles;
  bool informed;           ///< proposal = informed, not motion
  bool knownIds;           ///< association = known, not nn
  double newDensity;       ///< p_new [1/(m rad)]; 0: that of a pair at the inner gate's edge
  double rangeStd;         ///< [m]; 0: what the log says
  double bearingStd;       ///< [rad]; 0: what the log says
  double correlationTime;  ///< [s] over which sightings of one thing share their error; 0: none do
  SightingTracks::Settings tracking;  ///< nn: what follows a post from scan to scan
  int confirmSightings;               ///< landmarks seen less often are not reported
  double detection;                   ///< chance to see a landmark in view; 0: misses tell nothing
  ::mrpt::bayes::CParticleFilter::TParticleFilterOptions resampling;

  static Settings from(core::Params& p);
  /// What multiplies the variances of a thing's sighting this long [s] after its last one:
  /// sightings that share their error within a time tell no more, all together, than one would.
  [[nodiscard]] double noiseAfter(double pause) const;

  using TargetSettings::ray;
  [[nodiscard]] Ray ray(const core::Sighting& s) const;
};
}  // namespace slamot::filters::rbpf
