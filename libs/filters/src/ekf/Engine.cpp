#include "Engine.h"

#include "relate.h"

#include <slamot/core/Error.h>
#include <slamot/core/checkStep.h>

#include <limits>

namespace slamot::filters::ekf
{
using Kind = core::Pairing::Outcome;

template <class Motion>
EngineOf<Motion>::EngineOf(const Settings& settings, const Motion& motion,
                           const std::vector<core::FilterContext>& contexts, const Mates& mates)
    : settings_(settings),
      motion_(motion),
      mates_(mates),
      belief_(static_cast<int>(contexts.size()), kSize),
      map_(settings_, belief_),
      tracks_(settings.tracks),
      time_(-std::numeric_limits<double>::infinity())
{
  for (std::size_t r = 0; r < contexts.size(); ++r)
  {
    const core::Starts& starts = contexts[r].starts;
    const Gaussian<Pose2D> pose = starts.robotPose();
    belief_.set(belief_.robot(static_cast<int>(r)),
                Vector3(pose.mean.x, pose.mean.y, pose.mean.phi), pose.cov);
    predicted_.emplace_back(pose.mean.x, pose.mean.y);
    times_.push_back(starts.time.value_or(time_));
    time_ = std::max(time_, times_.back());
    for (const auto& [id, start] : starts.targets) startTarget(id, start, starts.time.value_or(0));
  }
}

template <class Motion>
std::unique_ptr<Hypothesis> EngineOf<Motion>::clone() const
{
  std::unique_ptr<EngineOf> out(new EngineOf(*this));
  out->map_.attach(out->settings_, out->belief_);
  return out;
}

template <class Motion>
void EngineOf<Motion>::move(int robot, const core::Step& step)
{
  double& last = times_[static_cast<std::size_t>(robot)];
  core::checkStep(step, last);
  if (step.odometry) moveRobot(belief_.robot(robot), *step.odometry);
  if (std::isfinite(time_) && step.time > time_) moveTargets(step.time - time_);
  last = step.time;
  time_ = std::max(time_, step.time);
}

template <class Motion>
core::Update EngineOf<Motion>::take(int robot, const core::Step& step,
                                    const core::LandmarkScan* landmarks)
{
  core::Update out;
  wrapAngles();  // hypotheses have taken landmarks already
  if (landmarks || step.blobs)
  {
    takeScan(belief_.robot(robot), step, landmarks, out.pairings);
    out.diagnostics.close = static_cast<int>(std::count_if(rows_.begin(), rows_.end(), isClose));
  }
  // First: a target that is NaN would be dropped, and nobody would know.
  if (!belief_.x().allFinite() || !belief_.P().diagonal().allFinite()) failOverflow();
  if (step.blobs) dropLost(step.time);
  out.estimate = estimate(robot);
  return out;
}

template <class Motion>
void EngineOf<Motion>::moveRobot(int robot, const Gaussian<Pose2D>& increment)
{
  const auto& x = belief_.x();
  const Pose2D pose(x[robot], x[robot + 1], x[robot + 2]);
  const Pose2D next = math::compose(pose, increment.mean);
  // By first estimates, the way is from where the robot was thought to be before the last update.
  Point2D& from = predicted_[static_cast<std::size_t>(robot / 3)];
  if (!settings_.firstEstimates) from = {pose.x, pose.y};
  Matrix3 F = Matrix3::Identity();
  F(0, 2) = from.y - next.y;
  F(1, 2) = next.x - from.x;
  from = {next.x, next.y};
  const Matrix3 R = math::poseRotation(pose.phi);
  belief_.move(robot, Vector3(next.x, next.y, next.phi), F, R * increment.cov * R.transpose());
}

template <class Motion>
void EngineOf<Motion>::takeScan(int robot, const core::Step& step, const core::LandmarkScan* scan,
                                std::vector<core::Pairing>& pairings)
{
  rows_.clear();
  Map::Scan landmarks;
  BlobScan blobs;
  if (scan) landmarks = map_.match(robot, *scan, step.time, rows_);
  if (step.blobs) matchTargets(robot, *step.blobs, step.time, blobs);
  std::vector<core::Pairing> ofMates;
  if (step.blobs) matchMates(robot, *step.blobs, step.time, ofMates);
  belief_.update(rows_);
  wrapAngles();
  updateBanks(robot, blobs, step.time);
  wrapAngles();
  if (scan)
  {
    const auto slots = map_.settle(robot, *scan, landmarks, step.time);
    for (std::size_t k = 0; k < slots.size(); ++k)
    {
      const std::int32_t m = landmarks.matches[k];
      const Kind kind = m >= 0 ? Kind::kKnown : m == kNew ? Kind::kNew : Kind::kRejected;
      pairings.push_back(
          {false, static_cast<int>(k), kind, slots[k] >= 0 ? map_.idOf(slots[k]) : core::kNoId});
    }
  }
  const std::size_t first = pairings.size();
  if (step.blobs) settleTargets(robot, blobs, step.time, pairings);
  pairings.insert(pairings.end(), ofMates.begin(), ofMates.end());
  std::sort(pairings.begin() + static_cast<std::ptrdiff_t>(first), pairings.end(),
            [](const auto& a, const auto& b) { return a.index < b.index; });
}

template <class Motion>
double EngineOf<Motion>::noiseOf(int robot, int mate, double time) const
{
  const auto it = mateSeen_.find({robot, mate});
  return it == mateSeen_.end() ? 1 : settings_.noiseAfter(time - it->second);
}

template <class Motion>
void EngineOf<Motion>::matchMates(int robot, const core::BlobScan& scan, double time,
                                  std::vector<core::Pairing>& pairings)
{
  if (mates_.label.empty()) return;
  const Eye eye = eyeOf(belief_, robot);
  candidates_.clear();
  std::vector<std::int32_t> matches(scan.blobs.size(), kNew);
  for (std::size_t k = 0; k < scan.blobs.size(); ++k)
  {
    const core::Blob& blob = scan.blobs[k];
    if (blob.label != mates_.label) continue;
    const Ray ray = settings_.ray(blob);
    for (int other = 0; other < belief_.robots(); ++other)
    {
      Innovation o;
      const int id = mates_.ids[static_cast<std::size_t>(other)];
      const bool isAnother = blob.id != core::kNoId && id != core::kNoId && blob.id != id;
      if (belief_.robot(other) == robot || isAnother ||
          !relate(belief_, robot, belief_.robot(other), eye, ray, o, noiseOf(robot, other, time)))
        continue;
      const double gate = ray.hasRange ? settings_.gates.inner : settings_.gates.inner1;
      candidates_.push_back(
          {o.d2 + std::log(o.det), static_cast<std::int32_t>(k), other, o.d2 <= gate});
    }
  }
  matchGreedily(candidates_, matches);
  for (std::size_t k = 0; k < scan.blobs.size(); ++k)
  {
    if (scan.blobs[k].label != mates_.label) continue;
    pairings.push_back({true, static_cast<int>(k), Kind::kRejected, core::kNoId});
    if (matches[k] < 0) continue;
    const Ray ray = settings_.ray(scan.blobs[k]);
    Innovation o;
    const int other = belief_.robot(matches[k]);
    const double noise = noiseOf(robot, matches[k], time);
    if (!relate(belief_, robot, other, eye, ray, o, noise)) continue;
    rows_.push_back(ekf::rowsOf(robot, other, o, ray, noise));
    mateSeen_[{robot, matches[k]}] = time;
  }
}

template <class Motion>
void EngineOf<Motion>::wrapAngles()
{
  auto& x = belief_.x();
  for (int r = 0; r < belief_.robots(); ++r)
    x[belief_.robot(r) + 2] = math::wrapToPi(x[belief_.robot(r) + 2]);
  if constexpr (Motion::kAngle >= 0)
    for (const Target& t : targets_)
    {
      double& angle = x[belief_.target(t.slot) + Motion::kAngle];
      angle = math::wrapToPi(angle);
    }
}

template <class Motion>
core::Estimate EngineOf<Motion>::estimate(int robot) const
{
  core::Estimate out;
  out.time = times_[static_cast<std::size_t>(robot)];
  const int j = belief_.robot(robot);
  const auto& x = belief_.x();
  out.robot = {{x[j], x[j + 1], x[j + 2]}, belief_.P().template block<3, 3>(j, j)};
  for (std::size_t t = 0; t < targets_.size(); ++t)
  {
    const Track& track = tracks_.list()[t];
    if (!track.confirmed) continue;
    const State state = stateOf(targets_[t]);
    core::TargetEstimate target;
    target.id = track.id;
    target.label = track.label;
    target.identified = track.identified;
    target.lastSeen = track.lastSeen;
    target.pose = Motion::pose(state);
    target.velocity = Motion::velocity(state, target.velocityCov);
    out.targets.push_back(target);
  }
  std::sort(out.targets.begin(), out.targets.end(),
            [](const auto& a, const auto& b) { return a.id < b.id; });
  out.landmarks = &map_;
  return out;
}

template class EngineOf<models::DifferentialDriveTarget>;
template class EngineOf<models::DampedVelocityTarget>;
template class EngineOf<models::ConstantVelocityTarget>;
template class EngineOf<models::ConstantAccelerationTarget>;
template class EngineOf<models::ManoeuvringTarget>;
}  // namespace slamot::filters::ekf
