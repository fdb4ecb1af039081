#pragma once

#include "sighting/SensorSettings.h"

namespace slamot::filters::ekf
{
enum class Association
{
  kKnown,    ///< by the log's identities
  kNearest,  ///< cheapest pair first
  kJoint     ///< joint compatibility
};

/// The keys of section [ekf-slamot] but for the target's motion.
struct Settings : TargetSettings, LandmarkNoise
{
  Association association;
  double gateProbability;  ///< that a true pair, or a true set of pairs, is kept
  int confirmSightings;    ///< landmarks seen less often are not reported
  double tentativeTime;    ///< [s] without a sighting, after which one not yet reported is dropped
  bool firstEstimates;     ///< derivatives by pose and landmark at their first estimates
  double localRadius;      ///< [m] about the robot, within which landmarks are local; 0: all are

  static Settings from(core::Params& p);
  using LandmarkNoise::ray;
  using TargetSettings::ray;
};
}  // namespace slamot::filters::ekf
