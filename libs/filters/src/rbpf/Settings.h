#pragma once

#include "SightingTracks.h"
#include "sighting/SensorSettings.h"

#include <mrpt/bayes/CParticleFilter.h>

namespace slamot::filters::rbpf
{
enum class Proposal
{
  kMotion,     ///< the motion alone
  kInformed,   ///< the Gaussian that takes in the scan, linearised
  kUnscented,  ///< the same by unscented transforms
};
enum class Association
{
  kKnown,
  kNearest,
  kSequential,
  kJoint,
  kLikelihood
};
/// What a particle's weight takes from an intensity map.
enum class IntensityWeight
{
  kCluster,
  kSingleFeature,
  kEmptySet
};

/// What mixtures of Gaussians are kept by, as landmarks' and targets' intensities.
struct MixtureSettings
{
  double birthWeight;         ///< of a component born from a sighting
  double pruneWeight;         ///< components below are dropped
  double mergeDistance2;      ///< squared Mahalanobis distance within which components are merged
  double floorVar;            ///< added to their covariances for that distance [m², (m/s)², ...]
  int mostComponents;         ///< of a particle
  double confirm, unconfirm;  ///< expected number at which one is reported, and no more is

  /// \param prefix of the keys.
  /// \param otherwise what holds where a key is absent.
  static MixtureSettings from(core::Params& p, const std::string& prefix,
                              const MixtureSettings& otherwise);
  static std::vector<std::string> keys(const std::string& prefix);
};

/// Keys of a map that is a GM-PHD intensity.
struct IntensitySettings : MixtureSettings
{
  IntensityWeight weight;
};

/// Keys of moving targets that are a GM-PHD intensity.
struct TargetSetSettings : MixtureSettings
{
  double survival;   ///< chance that a target is still there a second later
  double detection;  ///< chance to see a target in view
  double clutter;    ///< false blobs a scan, mean
};

/// What the members of the family set when the configuration does not.  Absent: a key without
/// default.
struct Preset
{
  std::optional<int> particles;
  std::optional<std::string> proposal, association;
  std::string mapUpdate = "ekf", map = "landmarks", weight = "marginal";
};

/// The keys of a section like [rbpf-slamot] but for the target's motion.
struct Settings : TargetSettings, LandmarkNoise
{
  int particles;
  Proposal proposal;
  bool unscentedMap;    ///< map_update = unscented, not ekf
  bool sequential;      ///< the proposal takes in sightings one by one, each seen from the last
  bool marginalWeight;  ///< weight = marginal, not sampled
  /// Of the last weight in the next: below 1, evidence is forgotten.  Zhu and Jin 2018.
  double weightExponent;
  Association association;
  double gateProbability;
  double newDensity;  ///< p_new [1/(m rad)]; 0: that of a pair at the inner gate's edge
  SightingTracks::Settings tracking;  ///< nn: what follows a post from scan to scan
  int confirmSightings;               ///< landmarks seen less often are not reported
  double detection;                   ///< chance to see a landmark in view; 0: misses tell nothing
  double clutter;                     ///< false sightings a scan, mean; 0: not known
  std::optional<IntensitySettings> intensity;  ///< map = gm-phd, not landmarks
  std::optional<TargetSetSettings> targetSet;  ///< targets = gm-phd, not tracks
  ::mrpt::bayes::CParticleFilter::TParticleFilterOptions resampling;

  static Settings from(core::Params& p, const Preset& preset);
  using LandmarkNoise::ray;
  using TargetSettings::ray;
  [[nodiscard]] bool isInformed() const { return proposal != Proposal::kMotion; }
  /// Density of false sightings over range and bearing [1/(m rad)].
  [[nodiscard]] double clutterDensity(const core::FieldOfView& fov) const
  {
    return clutter / ((fov.rangeMax - fov.rangeMin) * (fov.bearingMax - fov.bearingMin));
  }
  /// Whether a scan's pairs are judged together.
  [[nodiscard]] bool isJoint() const
  {
    return association != Association::kKnown && association != Association::kNearest;
  }
  [[nodiscard]] bool isKnown() const { return association == Association::kKnown; }
};
}  // namespace slamot::filters::rbpf
