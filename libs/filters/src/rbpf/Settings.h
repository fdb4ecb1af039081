#pragma once

#include "Targets.h"

#include <mrpt/bayes/CParticleFilter.h>

namespace slamot::filters::rbpf
{
/// The keys of section [rbpf-slamot] (and of [independent]) but for the target's motion.
struct Settings
{
  int particles;
  bool informed;           ///< proposal = informed, not motion
  bool knownIds;           ///< association = known, not nn
  Gates gates;
  double newDensity;       ///< p_new [1/(m rad)]; 0: that of a pair at the inner gate's edge
  double rangeStd;         ///< [m]; 0: what the log says
  double bearingStd;       ///< [rad]; 0: what the log says
  double targetRangeStd, targetBearingStd;
  int confirmSightings;    ///< landmarks seen less often are not reported
  double detection;        ///< chance to see a landmark in view; 0: misses tell nothing
  TrackRules tracks;
  ::mrpt::bayes::CParticleFilter::TParticleFilterOptions resampling;

  static Settings from(core::Params& p);
  [[nodiscard]] Ray ray(const core::Sighting& s) const;
  [[nodiscard]] Ray ray(const core::Blob& b) const;
};
}  // namespace slamot::filters::rbpf
