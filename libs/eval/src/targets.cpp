#include <slamot/math/statistics.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "poseErrors.h"

namespace slamot::eval
{
namespace
{
/// The errors of some tracks against one true target.
class TargetErrors
{
 public:
  TargetErrors(const Record& record, const Truth& truth, const EvaluationOptions& options,
               const Pose2D& truthFromMap, int truthId)
      : record_(record),
        truth_(truth),
        trajectory_(truth.targets.at(truthId)),
        options_(options),
        truthFromMap_(truthFromMap)
  {
  }

  void add(const TargetTrack& track)
  {
    for (const TargetRow& t : track.rows)
    {
      const RobotRow& row = record_.rows[t.row];
      const auto truth = trajectory_.at(row.time, options_.maxTruthGap);
      if (!truth) continue;
      errors_.push_back(poseError(t.row, t.pose, *truth, truthFromMap_));
      ages_.push_back(row.time - t.lastSeen);
      addVelocity(t.velocity, row.time, *truth);
      tracked_.insert(t.row);
      if (!sighted(t)) continue;
      sightings_.push_back(errors_.back());
      if (const auto robot = truth_.robot.at(row.time, options_.maxTruthGap);
          robot && robot->headingKnown)
        relative_.push_back(relativeError(t.row, row.robot.mean, t.pose.mean, robot->pose, *truth));
    }
  }

  /// How far the tracks are from the target [m]: at sightings and relative to the observer where
  /// possible, so that neither an old loss nor the robot's drift hides which target it is.
  [[nodiscard]] std::optional<double> medianError() const
  {
    const auto& steps = !relative_.empty() ? relative_ : !sightings_.empty() ? sightings_ : errors_;
    if (steps.empty()) return std::nullopt;
    std::vector<double> distances;
    for (const StepError& s : steps) distances.push_back(s.error.head<2>().norm());
    return math::quantile(distances, 0.5);
  }

  void fill(TargetEvaluation& out) const
  {
    out.steps = errors_;
    out.all = summarise(errors_);
    out.atScans = summarise(errors_, [&](const StepError& s) { return record_.rows[s.row].scan; });
    out.atSightings = summarise(sightings_);
    out.relativeAtSightings = summarise(relative_);
    for (std::size_t i = 0; i + 1 < options_.sinceSeenEdges.size(); ++i)
      out.sinceSeen.push_back(ageBin(options_.sinceSeenEdges[i], options_.sinceSeenEdges[i + 1]));
    out.speedRmse = rootMeanSquare(speeds_);
    if (velocities_ > 0)
      out.velocityRmse = (velocitySquares_ / static_cast<double>(velocities_)).cwiseSqrt();
    out.trackedFraction = trackedFraction(-1e300);
    if (const auto moved = firstMoved()) out.trackedSinceMoved = trackedFraction(*moved);
  }

 private:
  // Seen since the row before; a known start is no sighting.
  [[nodiscard]] bool sighted(const TargetRow& t) const
  {
    return record_.rows[t.row].scan && (t.row == 0 || t.lastSeen > record_.rows[t.row - 1].time);
  }

  [[nodiscard]] SinceSeen ageBin(double from, double to) const
  {
    std::vector<StepError> inBin;
    for (std::size_t i = 0; i < errors_.size(); ++i)
      if (ages_[i] >= from && ages_[i] < to) inBin.push_back(errors_[i]);
    return {from, to, summarise(inBin)};
  }

  void addVelocity(const Vector2& estimate, double time, const TimedPose& truth)
  {
    const auto ofPath = pathVelocity(time);
    if (ofPath) speeds_.push_back(estimate.norm() - ofPath->norm());
    const auto truly = truth.velocity ? truth.velocity : ofPath;
    if (!truly) return;
    const double c = std::cos(truthFromMap_.phi), s = std::sin(truthFromMap_.phi);
    const Vector2 turned(c * estimate.x() - s * estimate.y(), s * estimate.x() + c * estimate.y());
    velocitySquares_ += (turned - *truly).cwiseAbs2();
    ++velocities_;
  }

  /// That of the true path, over 0.2 s around.
  [[nodiscard]] std::optional<Vector2> pathVelocity(double time) const
  {
    constexpr double kHalf = 0.1;  // [s]
    const auto before = trajectory_.at(time - kHalf, options_.maxTruthGap);
    const auto after = trajectory_.at(time + kHalf, options_.maxTruthGap);
    if (!before || !after) return std::nullopt;
    return Vector2(after->pose.x - before->pose.x, after->pose.y - before->pose.y) / (2 * kHalf);
  }

  [[nodiscard]] static std::optional<double> rootMeanSquare(const std::vector<double>& v)
  {
    if (v.empty()) return std::nullopt;
    const double sum = std::inner_product(v.begin(), v.end(), v.begin(), 0.0);
    return std::sqrt(sum / static_cast<double>(v.size()));
  }

  /// [s]; none: it stands all the time.
  [[nodiscard]] std::optional<double> firstMoved() const
  {
    constexpr double kMoved = 0.05;  // [m]
    const auto& poses = trajectory_.poses;
    for (const TimedPose& p : poses)
      if (std::hypot(p.pose.x - poses.front().pose.x, p.pose.y - poses.front().pose.y) > kMoved)
        return p.time;
    return std::nullopt;
  }

  [[nodiscard]] std::optional<double> trackedFraction(double since) const
  {
    std::size_t withTruth = 0, tracked = 0;
    for (std::size_t i = 0; i < record_.rows.size(); ++i)
    {
      const double time = record_.rows[i].time;
      if (time < since || !trajectory_.at(time, options_.maxTruthGap)) continue;
      ++withTruth;
      tracked += tracked_.count(i);
    }
    if (withTruth == 0) return std::nullopt;
    return static_cast<double>(tracked) / static_cast<double>(withTruth);
  }

  const Record& record_;
  const Truth& truth_;
  const Trajectory& trajectory_;
  const EvaluationOptions& options_;
  Pose2D truthFromMap_;
  std::vector<StepError> errors_, sightings_, relative_;
  std::vector<double> ages_;                   // of errors_, since the last sighting [s]
  std::vector<double> speeds_;                 // errors [m/s]
  Vector2 velocitySquares_ = Vector2::Zero();  // summed errors of so many velocities
  int velocities_ = 0;
  std::set<std::size_t> tracked_;  // rows
};

/// Which true target a track stands for.
std::optional<int> truthOf(const TargetTrack& track, const Record& record, const Truth& truth,
                           const EvaluationOptions& options, const Pose2D& truthFromMap)
{
  if (track.identified)
    return truth.targets.count(track.id) ? std::optional<int>(track.id) : std::nullopt;
  std::optional<int> best;
  double smallest = options.targetCutoff;
  for (const auto& [id, _] : truth.targets)
  {
    TargetErrors errors(record, truth, options, truthFromMap, id);
    errors.add(track);
    const auto median = errors.medianError();
    if (!median || *median > smallest) continue;
    smallest = *median;
    best = id;
  }
  return best;
}
}  // namespace

std::vector<TargetEvaluation> evaluateTracks(const Record& record, const Truth& truth,
                                             const EvaluationOptions& options,
                                             const Pose2D& truthFromMap)
{
  std::vector<TargetEvaluation> out;
  for (const TargetTrack& track : record.targets)
  {
    TargetEvaluation t;
    t.id = track.id;
    t.truthId = truthOf(track, record, truth, options, truthFromMap);
    if (t.truthId)
    {
      TargetErrors errors(record, truth, options, truthFromMap, *t.truthId);
      errors.add(track);
      errors.fill(t);
    }
    out.push_back(std::move(t));
  }
  return out;
}

std::vector<TargetEvaluation> evaluateTrueTargets(const Record& record, const Truth& truth,
                                                  const EvaluationOptions& options,
                                                  const Pose2D& truthFromMap,
                                                  const std::vector<TargetEvaluation>& tracks)
{
  std::vector<TargetEvaluation> out;
  for (const auto& [id, _] : truth.targets)
  {
    TargetErrors errors(record, truth, options, truthFromMap, id);
    for (std::size_t i = 0; i < record.targets.size(); ++i)
      if (tracks[i].truthId == id) errors.add(record.targets[i]);
    TargetEvaluation t;
    t.id = id;
    t.truthId = id;
    errors.fill(t);
    out.push_back(std::move(t));
  }
  return out;
}
}  // namespace slamot::eval
