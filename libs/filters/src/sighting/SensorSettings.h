#pragma once

#include "Targets.h"

namespace slamot::filters
{
/// The keys of a filter that follows targets, but for the target's motion.
struct TargetSettings
{
  Gates gates;
  TrackRules tracks;
  double targetRangeStd;                              ///< [m]; 0: what the log says
  double targetBearingStd;                            ///< [rad]; 0: what the log says
  std::shared_ptr<const models::NoiseLaw> targetLaw;  ///< of blobs' errors; null: normal

  static TargetSettings from(core::Params& p);
  [[nodiscard]] Ray ray(const core::Blob& b) const;
};

/// What is told of landmark sightings' errors.
struct LandmarkNoise
{
  double rangeStd;         ///< [m]; 0: what the log says
  double bearingStd;       ///< [rad]; 0: what the log says
  double correlationTime;  ///< [s] over which sightings of one thing share their error; 0: none do
  std::shared_ptr<const models::NoiseLaw> law;  ///< of sightings' errors; null: normal
  double reach = 1;                             ///< Ray::reach by the law

  /// \param gate the squared distance within which a sighting may be of a thing.
  static LandmarkNoise from(core::Params& p, double gate);
  [[nodiscard]] Ray ray(const core::Sighting& s) const;
  /// What multiplies the variances of a thing's sighting this long [s] after its last one:
  /// sightings that share their error within a time tell no more, all together, than one would.
  [[nodiscard]] double noiseAfter(double pause) const;
};
}  // namespace slamot::filters
