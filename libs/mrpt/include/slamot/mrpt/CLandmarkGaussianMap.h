#pragma once

#include <mrpt/maps/CMetricMap.h>
#include <slamot/core/Estimate.h>
#include <slamot/mrpt/mrpt_compat.h>

#include <cstdint>
#include <string>
#include <vector>

namespace slamot::maps
{
/// \cond
namespace mrpt = ::mrpt;  // MRPT's macros say `mrpt::`, which slamot::mrpt would hide
/// \endcond

/// A filter's map as MRPT's programs take it: landmarks in the plane, each a Gaussian of its own.
/// For exchange, pictures and multi-metric maps (`landmarkGaussianMap_count = 1`).  An estimator's
/// own map it is not: poses are taken as exact, and each call looks through all landmarks.
class CLandmarkGaussianMap : public ::mrpt::maps::CMetricMap
{
  DEFINE_SERIALIZABLE(CLandmarkGaussianMap, slamot::maps)

 public:
  static constexpr std::uint32_t kMostLandmarks = 1000000;  ///< in one map, when read back

  /// One landmark of the map.
  struct Landmark
  {
    std::int32_t id = 0;         ///< its identity, or its number; not negative
    Gaussian<Point2D> position;  ///< in map axes
    std::int32_t sightings = 0;  ///< how often it was seen
    double existence = 1;        ///< probability that it exists; 1: nobody doubts it
  };

  /// How sightings (CObservationBearingRange) are taken.  From an ini file: section
  /// `<name>_landmarkGaussianMap_00_insertOpts`, keys below; they hold for the likelihood too.
  struct TInsertionOptions : public ::mrpt::config::CLoadableOptions
  {
    double gateProbability = 0.99;                ///< gate_probability: a true pair is kept, (0, 1)
    double rangeStd = 0.1;                        ///< range_std_m, of observations without any
    double bearingStd = 0.017453292519943295769;  ///< bearing_std_deg, likewise; here in [rad]

    /// \throws core::Error of kConfig: unknown key, not a number, out of range; nothing is changed.
    void loadFromConfigFile(const ::mrpt::config::CConfigFileBase& source,
                            const std::string& section) override;
    /// Writes the keys that loadFromConfigFile() reads.
    void saveToConfigFile(::mrpt::config::CConfigFileBase& target,
                          const std::string& section) const override;
  };
  TInsertionOptions insertionOptions;  ///< how insertObservation() and likelihoods pair and weigh

  /// The map of a filter; its landmarks are confirmed ones, so their existence is 1.
  [[nodiscard]] static CLandmarkGaussianMap fromView(const core::LandmarkView& view);

  /// In rising order of ids.
  [[nodiscard]] const std::vector<Landmark>& landmarks() const { return landmarks_; }
  /// None: nullptr.
  [[nodiscard]] const Landmark* find(std::int32_t id) const;
  /// Adds a landmark, or replaces the one of this id.
  /// \throws std::domain_error: a negative id or count, a position that is not finite, a covariance
  /// with a negative eigenvalue, an existence outside [0, 1].
  void set(const Landmark& landmark);

  /// Whether it has no landmark.
  bool isEmpty() const override { return landmarks_.empty(); }
  /// How many landmarks it has, in words.
  std::string asString() const override;

  /// Writes `<prefix>_landmarks.csv`: id,x,y,cxx,cxy,cyy,sightings,existence [m, m²].
  /// \throws core::Error of kUnreadable if it can't be written.
  void saveMetricMapRepresentationToFile(const std::string& prefix) const override;

  /// Ellipses that hold 95%, and the ids beside them.
  void getVisualizationInto(slamot_viz::CSetOfObjects& o) const override;

 private:
  void internal_clear() override { landmarks_.clear(); }

  /// An extended Kalman update of each landmark seen from this pose, taken into the plane.
  /// Sightings with an identity update or found the landmark of that id.  Those without go to the
  /// nearest landmark within the gate, at most one of an observation to each: a second one is
  /// ambiguous and dropped; out of all gates they found a landmark, numbered above all ids.  So one
  /// map takes sensors that tell identities, or such that don't, not both.
  /// \returns whether the map changed; false for other classes.
  /// \throws std::invalid_argument for values that make no sense; the map is then unchanged.
  bool internal_insertObservation(
      const ::mrpt::obs::CObservation& obs,
      const std::optional<const ::mrpt::poses::CPose3D>& robotPose) override;

  /// Sum over the sightings of log N(z; h, H P Hᵀ + R), [m, rad]: of the landmark of that identity,
  /// or of the nearest one, whose distance then counts as the gate's at most.  A sighting of an
  /// identity not on the map says nothing of the pose: 0; so does any on an empty map.
  /// 0 for other classes.  \throws as internal_insertObservation().
  double internal_computeObservationLikelihood(
      const ::mrpt::obs::CObservation& obs, const ::mrpt::poses::CPose3D& takenFrom) const override;

  bool internal_canComputeObservationLikelihood(
      const ::mrpt::obs::CObservation& obs) const override;

  std::vector<Landmark> landmarks_;

  MAP_DEFINITION_START(CLandmarkGaussianMap)
  TInsertionOptions insertionOpts;
  MAP_DEFINITION_END(CLandmarkGaussianMap)
};
}  // namespace slamot::maps
