#pragma once

#include <slamot/eval/Gospa.h>
#include <slamot/eval/Record.h>
#include <slamot/eval/ScanMap.h>
#include <slamot/eval/Truth.h>

namespace slamot::eval
{
/// How the map's frame is laid over the truth's before errors are taken; never scaled.
enum class Align
{
  kNone,       ///< frames are the same, as where starts are given
  kFirstPose,  ///< the first pose with truth agrees exactly
  kRigid       ///< least squares over all positions of the robot
};

/// Error of one estimated pose.
struct StepError
{
  std::size_t row = 0;                 ///< place in Record::rows
  Vector3 error{0, 0, 0};              ///< estimate less truth, in the truth's axes [m, m, rad]
  bool headingKnown = false;           ///< else error[2] is 0 and means nothing
  std::optional<double> nees;          ///< eᵀP⁻¹e over (x, y, heading); none if P is singular
  std::optional<double> neesPosition;  ///< the same over (x, y)
};

/// Errors over a set of steps; absent where no step had what it needs.
struct ErrorSummary
{
  int count = 0;                           ///< steps with truth
  std::optional<double> positionMean;      ///< [m]
  std::optional<double> positionMedian;    ///< [m]
  std::optional<double> positionRmse;      ///< [m]
  std::optional<double> headingRmse;       ///< [rad]
  std::optional<double> neesMean;          ///< 3 degrees of freedom
  std::optional<double> neesPositionMean;  ///< 2 degrees of freedom
  std::optional<double> coverage95;        ///< share of steps inside the 95% ellipse of position
  int neesSkipped =
      0;  ///< steps left out of the last two: covariance singular, as of an exact start
};

/// Errors of the robot's estimates at the record's rows.
struct RobotEvaluation
{
  std::vector<StepError> steps;  ///< of rows with truth
  ErrorSummary all;              ///< at every step
  ErrorSummary atScans;          ///< where landmarks or blobs were looked for
};

/// Errors in the common frame of steps whose target was last seen `from` to `to` seconds before.
struct SinceSeen
{
  double from = 0;      ///< [s]: from <= age < to
  double to = 0;        ///< [s]
  ErrorSummary errors;  ///< of these steps
};

/// Errors of a track, or of all tracks of a true target.
struct TargetEvaluation
{
  int id = core::kNoId;          ///< of the track; of the truth in Evaluation::trueTargets
  std::optional<int> truthId;    ///< none: no true target is near, or its identity has no truth
  std::vector<StepError> steps;  ///< in the common frame
  ErrorSummary all;              ///< at every step with an estimate
  ErrorSummary atScans;          ///< where landmarks or blobs were looked for
  ErrorSummary atSightings;      ///< where this target was seen
  /// In the observer's frame, at steps with a sighting: free of the robot's own error; no NEES.
  ErrorSummary relativeAtSightings;
  std::vector<SinceSeen> sinceSeen;  ///< by EvaluationOptions::sinceSeenEdges
  std::optional<double> speedRmse;   ///< [m/s], against the true path over 0.2 s around
  /// Of each component, in the truth's axes [m/s]: against the true velocity, where truth tells it,
  /// else as the speed.
  std::optional<Vector2> velocityRmse;
  std::optional<double> trackedFraction;  ///< of the rows with truth, those that have an estimate
  /// The same from when it has first moved, by 0.05 m: until then nothing but a known start tells
  /// it from what stands.
  std::optional<double> trackedSinceMoved;
};

/// A landmark of the map and the true one that it stands for.
struct LandmarkMatch
{
  std::size_t index = 0;       ///< place in Record::landmarks
  int truthId = 0;             ///< as in Truth::landmarks
  double error = 0;            ///< [m]
  std::optional<double> nees;  ///< 2 degrees of freedom
};

/// The map against the true landmarks.
struct LandmarkEvaluation
{
  std::vector<LandmarkMatch> matches;  ///< by rising `index`
  std::optional<int> mapped;           ///< landmarks of the map; none: the filter makes no map
  std::optional<int> trueOnes;         ///< those that stand for a true one; the rest is false
  std::optional<int> seen;             ///< true landmarks with a sighting; none: truth doesn't tell
  std::optional<double> rmse;          ///< [m], over the matches
  std::optional<double> neesMean;      ///< over the matches; 2 expected
  std::optional<Gospa>
      gospa;  ///< of the maps as sets of points, cut off at EvaluationOptions::gospaCutoff
};

/// Landmark sightings by what became of them.  Alignment changes nothing about them.
struct AssociationCounts
{
  std::optional<int> correct;  ///< paired with the landmark that it is truly of; none without truth
  std::optional<int> wrong;    ///< paired with another one; none without truth
  int created = 0;             ///< taken for a new landmark
  int rejected = 0;            ///< neither paired nor new
  // Without truth 0:
  int sightings = 0;      ///< truly of a landmark
  int founded = 0;        ///< of these, new ones, and the first that were made of their landmark
  int clutter = 0;        ///< truly of none
  int clutterPaired = 0;  ///< of these, paired with a landmark all the same

  /// Of what was paired, what was paired rightly.
  [[nodiscard]] std::optional<double> rightOfPaired() const;
  /// Of sightings of landmarks, those paired rightly or rightly taken for new.
  [[nodiscard]] std::optional<double> rightOfSightings() const;
  /// Of clutter, what was paired.
  [[nodiscard]] std::optional<double> pairedOfClutter() const;
};

/// The targets that are tracked against those that are there, as sets without identities: means
/// over the scans.
struct TargetSetErrors
{
  int scans = 0;            ///< that the means are over
  double estimated = 0;     ///< targets that are tracked
  double truly = 0;         ///< targets that are there
  double gospa = 0;         ///< [m]
  double localisation = 0;  ///< [m²], of pairs: part of GOSPA
  double missed = 0;        ///< [m²], of true targets without a track: part of GOSPA
  double falseOnes = 0;     ///< [m²], of tracks without a true target: part of GOSPA
  double ospa = 0;          ///< [m]
};

/// What an alignment changes, after rigid ones: free of where a path, or a map, lies as a whole.
struct RigidEvaluation
{
  Pose2D truthFromMap;                       ///< of the path, and of the targets with it
  ErrorSummary robot;                        ///< its path
  std::optional<TargetSetErrors> targetSet;  ///< none: there are no true targets, or no scans
  /// The map has its own: a path was recorded while the map still drifted.
  Pose2D truthFromLandmarks;
  LandmarkEvaluation landmarks;  ///< the map
};

/// Errors of a path over relations, each between two of its poses: free of where the path lies as a
/// whole, and of what was gathered before and after.
struct RelationErrors
{
  int count = 0;                          ///< relations whose times are both those of poses
  std::optional<double> translationMean;  ///< [m]
  std::optional<double> rotationMean;     ///< [rad]
};

/// All that a run is judged by.
struct Evaluation
{
  Align align = Align::kNone;  ///< as it was made, which may be less than what was asked for
  Pose2D truthFromMap;         ///< takes the map's frame to the truth's
  RobotEvaluation robot;       ///< its path
  /// One for each track, then, under their own free ids, the true targets that no track stands for.
  std::vector<TargetEvaluation> targets;
  /// One for each true target, over all tracks that stand for it; `id` is the truth's.
  std::vector<TargetEvaluation> trueTargets;
  std::optional<TargetSetErrors> targetSet;      ///< none: there are no true targets, or no scans
  LandmarkEvaluation landmarks;                  ///< the map
  std::optional<AssociationCounts> association;  ///< none: the filter pairs nothing
  std::optional<RigidEvaluation> rigid;          ///< none without the robot's truth
  std::optional<RelationErrors> relations;       ///< none: truth has none
  std::optional<RelationErrors> pathRelations;   ///< of the final path; none: also without one
  std::optional<ScanMapQuality> scanMap;         ///< none: the record has no scans
};

/// How a run is to be judged.
struct EvaluationOptions
{
  Align align = Align::kNone;   ///< which alignment to make, if the truth allows it
  double landmarkCutoff = 1.0;  ///< a landmark farther than this from any true one is false [m]
  double gospaCutoff = 1.0;     ///< GOSPA's and OSPA's c, of landmarks and of targets [m]
  double targetCutoff = 2.0;    ///< a track whose median error is larger stands for no target [m]
  double maxTruthGap = 2.0;     ///< truth is interpolated over gaps up to this [s]
  /// The point of the robot, in its own frame [m], whose path the truth is of, as of an antenna;
  /// the robot's errors and the alignment are taken there.
  Point2D leverArm{0, 0};
  std::vector<double> sinceSeenEdges = {0, 1, 3, 10, 30, 1e9};  ///< [s]
};

/// Mean errors over the relations whose times are both within `tolerance` [s] of a pose: how far
/// and by what angle the path's relation is off the reference's.  None if there are no relations.
/// Kuemmerle et al., "On measuring the accuracy of SLAM algorithms", 2009, equations 4 and 5, not
/// squared.
[[nodiscard]] std::optional<RelationErrors> evaluateRelations(
    const Trajectory& path, const std::vector<Relation>& relations, double tolerance = 5e-4);
/// The same of a run's poses.
[[nodiscard]] std::optional<RelationErrors> evaluateRelations(
    const Record& record, const std::vector<Relation>& relations);

/// Errors and consistency of a run.  What has no truth is absent; nothing is ever NaN.  Where the
/// truth does not allow the alignment asked for, none is made, and the result's `align` says so.
[[nodiscard]] Evaluation evaluate(const Record& record, const Truth& truth,
                                  const EvaluationOptions& options);

/// The same with known alignments, as of several robots together.
[[nodiscard]] Evaluation evaluate(const Record& record, const Truth& truth,
                                  const EvaluationOptions& options, const Pose2D& truthFromMap,
                                  const std::optional<Pose2D>& rigid);
}  // namespace slamot::eval
