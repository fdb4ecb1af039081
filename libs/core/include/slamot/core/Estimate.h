#pragma once

#include <slamot/core/Step.h>

#include <functional>

namespace slamot::core
{
/// One confirmed landmark.
struct LandmarkEstimate
{
  int id = kNoId;              ///< the landmark's identity, or its number in order of confirmation
  Gaussian<Point2D> position;  ///< in map axes
  int sightings = 0;           ///< how often it was seen, in the whole run
};

/// Access to a filter's map without a copy.  Valid until the filter's next step.
class LandmarkView
{
 public:
  virtual ~LandmarkView() = default;
  /// Visits the confirmed landmarks in rising order of their ids.
  virtual void visit(const std::function<void(const LandmarkEstimate&)>& visitor) const = 0;
  /// How many visit() would visit.
  [[nodiscard]] virtual std::size_t size() const = 0;
};

/// One followed target.
struct TargetEstimate
{
  int id = kNoId;     ///< its identity where the sensor gives one, else the order of confirmation
  std::string label;  ///< of the blobs that it was seen by: "target", "robot", ...
  bool identified = false;                ///< whether `id` came from the sensor
  Gaussian<Pose2D> pose;                  ///< in map axes; heading from the motion model
  Vector2 velocity{0, 0};                 ///< [m/s], map axes
  Matrix2 velocityCov = Matrix2::Zero();  ///< of (vx, vy), map axes [m²/s²]
  double lastSeen = 0;                    ///< time of the last sighting [s]
};

/// What a filter believes after a step.
struct Estimate
{
  double time = 0;                          ///< of the step [s], the log's own clock
  Gaussian<Pose2D> robot;                   ///< in the map frame; covariance in map axes
  std::vector<TargetEstimate> targets;      ///< in rising order of ids
  const LandmarkView* landmarks = nullptr;  ///< null: the filter makes no map
};

/// What became of one sighting or blob (in particle filters: in the heaviest particle).
struct Pairing
{
  /// The three ends that a sighting can come to.
  enum class Outcome
  {
    kKnown,    ///< paired with a landmark or target that was there
    kNew,      ///< started one
    kRejected  ///< neither: ambiguous or implausible
  };
  bool isBlob = false;                   ///< `index` counts blobs; else landmark sightings
  int index = 0;                         ///< place in the step's list
  Outcome outcome = Outcome::kRejected;  ///< what the filter did with it
  int id = kNoId;                        ///< of the landmark or target
};

/// What a filter tells of its own workings at a step, for plots and reports.
struct Diagnostics
{
  std::optional<double> ess;            ///< effective sample size before resampling [particles]
  std::optional<double> largestWeight;  ///< of one particle before resampling, of a sum of 1
  int particles = 0;                    ///< 0: not a particle filter
  bool resampled = false;               ///< particles were drawn anew after this step
  /// Sightings so near that polar coordinates would not do, taken in the frame of their ray.
  int close = 0;
};

/// What a filter returns for a step.
struct Update
{
  Estimate estimate;              ///< what it believes now
  std::vector<Pairing> pairings;  ///< one for each sighting and blob that it looked at
  Diagnostics diagnostics;        ///< how it got there
};

/// Where the robot was at a time [s], in map axes.
struct PathPose
{
  double time = 0;  ///< [s], the log's own clock
  Pose2D pose;      ///< in the map frame
};

/// The robot's pose samples, for whoever draws them.
struct WeightedPose
{
  Pose2D pose;        ///< in the map frame
  double weight = 0;  ///< normalised
};
}  // namespace slamot::core
