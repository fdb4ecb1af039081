#pragma once

#include <slamot/core/Estimate.h>
#include <slamot/eval/Trajectory.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace slamot::eval
{
/// The robot at the start, or at an odometry step after its update and after those of steps without
/// odometry at the same instant.  Times rise strictly: where a log's do not, each row is 1 us after
/// the one before.
struct RobotRow
{
  double time = 0;         ///< [s], the log's own clock
  Gaussian<Pose2D> robot;  ///< in map axes
  Pose2D odometry;         ///< odometry alone, summed up from the start
  bool scan = false;       ///< whether landmarks or blobs were looked for since the row before
};

/// A target at the instant of a row.
struct TargetRow
{
  std::size_t row = 0;     ///< place in Record::rows
  Gaussian<Pose2D> pose;   ///< in map axes
  Vector2 velocity{0, 0};  ///< [m/s], map axes
  double lastSeen = 0;     ///< time of the last sighting [s]
};

/// One target from its start to its loss; a gap in the rows is a loss and a return.
struct TargetTrack
{
  int id = core::kNoId;         ///< its identity, or its number in order of confirmation
  std::string label;            ///< of its blobs
  bool identified = false;      ///< whether `id` came from the sensor
  std::vector<TargetRow> rows;  ///< in rising order
};

/// What became of one sighting or blob.
struct PairingRow
{
  double time = 0;           ///< [s]
  core::Pairing pairing;     ///< what the filter did with it
  int seenId = core::kNoId;  ///< the identity that the sensor gave, if any
};

/// One step's diagnostics; unlike rows, there is one for every step.
struct StepRow
{
  double time = 0;                      ///< [s], the log's own clock
  bool scan = false;                    ///< whether landmarks or blobs were looked for
  std::optional<double> ess;            ///< effective sample size before resampling [particles]
  std::optional<double> largestWeight;  ///< of one particle before that; not kept in files
  bool resampled = false;               ///< particles were drawn anew
  int known = 0;                        ///< sightings and blobs paired with what was there
  int created = 0;                      ///< that started a landmark or target
  int rejected = 0;                     ///< neither
  int dropped = 0;                      ///< left out by the source
};

/// A laser scan and where it was taken; kept only when the robot has moved on.
struct LaserRow
{
  std::size_t row = 0;  ///< place in Record::rows of the pose to draw it from
  std::shared_ptr<const core::LaserScan> scan;  ///< never null
};

/// All of a run that results, reports and evaluations are made from.
struct Record
{
  std::vector<RobotRow> rows;  ///< in rising order of time, the start first
  bool hasOdometry = true;     ///< whether the rows tell odometry's poses; older folders do not
  Trajectory path;  ///< the whole path as believed at the end; empty: the filter keeps none
  std::vector<TargetTrack> targets;               ///< in rising order of (identified first, id)
  bool hasMap = false;                            ///< whether the filter makes a map at all
  std::vector<core::LandmarkEstimate> landmarks;  ///< confirmed ones, at the end
  std::vector<PairingRow> pairings;               ///< in the order of the run
  std::vector<StepRow> steps;                     ///< in the order of the run
  std::vector<LaserRow> lasers;                   ///< empty unless asked for
  std::size_t observations = 0;                   ///< sightings, blobs and laser scans taken in
  int particles = 0;                              ///< 0: not a particle filter
  std::size_t close = 0;  ///< sightings too near for polar coordinates; not kept in files
  bool complete = false;  ///< false: interrupted, or the input ended too early

  /// Whether landmarks carry the sensor's identities: all sightings with one were paired by it.
  [[nodiscard]] bool landmarksIdentified() const;
};

/// The same with the robot's poses, and their covariances, those of another point of it; without
/// what is of the robot itself, scans and final path.
/// \param point_robot [m], in the robot's frame.
[[nodiscard]] Record ofPoint(Record record, const Point2D& point_robot);
}  // namespace slamot::eval
