#pragma once

#include "sighting/SensorSettings.h"

#include <optional>

namespace slamot::filters::ekf
{
enum class Association
{
  kKnown,    ///< by the log's identities
  kNearest,  ///< cheapest pair first
  kJoint,    ///< joint compatibility
  kSeveral   ///< hypotheses, each an EKF, of what sightings were of
};

/// What hypotheses are weighed by: how sightings arise.
struct ArrivalSettings
{
  int most;          ///< hypotheses kept
  double least;      ///< those less likely than this, by the best one, are dropped
  double merge;      ///< squared deviations between poses within which two hypotheses are one
  double detection;  ///< chance to see a landmark in view
  double clutter;    ///< false sightings a scan, mean, uniform over the field of view
  double arrivals;   ///< landmarks seen for the first time a scan, mean, likewise

  /// Density of sightings of nothing known [1/(m rad)].
  [[nodiscard]] double newDensity(const core::FieldOfView& fov) const
  {
    return (clutter + arrivals) /
           ((fov.rangeMax - fov.rangeMin) * (fov.bearingMax - fov.bearingMin));
  }
  /// Chance that a sighting of nothing known is of a landmark.
  [[nodiscard]] double firstExistence() const { return arrivals / (clutter + arrivals); }
};

/// What holds where the configuration is silent.
struct Preset
{
  std::string association = "known";
  bool firstEstimates = false;
};

/// The keys of sections [ekf-slamot] and [slamot] but for the target's motion.
struct Settings : TargetSettings, LandmarkNoise
{
  Association association;
  double gateProbability;  ///< that a true pair, or a true set of pairs, is kept
  int confirmSightings;    ///< landmarks seen less often are not reported
  double tentativeTime;    ///< [s] without a sighting, after which one not yet reported is dropped
  bool firstEstimates;     ///< derivatives by pose and landmark at their first estimates
  double localRadius;      ///< [m] about the robot, within which landmarks are local; 0: all are
  std::optional<ArrivalSettings> arrival;  ///< of hypotheses

  static Settings from(core::Params& p, const Preset& preset);
  using LandmarkNoise::ray;
  using TargetSettings::ray;
};
}  // namespace slamot::filters::ekf
