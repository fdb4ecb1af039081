#include <slamot/eval/Recorder.h>
#include <slamot/eval/ScanMap.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "movedOn.h"

namespace slamot::eval
{
namespace
{
constexpr double kSameInstant = 2e-9;  // [s]: result files print nanoseconds
constexpr double kApart = 1e-6;        // [s], between steps that a log gives one time

/// Whether landmarks or targets were looked for: a laser's scan may be of use for either, or not.
bool lookedFor(const core::Step& step, const core::Update& update)
{
  if (step.landmarks || step.blobs) return true;
  const auto& targets = update.estimate.targets;
  return !step.lasers.empty() &&
         std::any_of(targets.begin(), targets.end(),
                     [&](const core::TargetEstimate& t) { return t.lastSeen >= step.time; });
}

StepRow diagnosticsOf(const core::Step& step, const core::Update& update)
{
  StepRow out;
  out.time = step.time;
  out.scan = lookedFor(step, update);
  out.ess = update.diagnostics.ess;
  out.largestWeight = update.diagnostics.largestWeight;
  out.resampled = update.diagnostics.resampled;
  out.dropped = step.dropped;
  for (const core::Pairing& p : update.pairings)
  {
    if (p.outcome == core::Pairing::Outcome::kKnown) ++out.known;
    if (p.outcome == core::Pairing::Outcome::kNew) ++out.created;
    if (p.outcome == core::Pairing::Outcome::kRejected) ++out.rejected;
  }
  return out;
}

template <class List>
int idAt(const List& list, int index)
{
  if (index < 0 || static_cast<std::size_t>(index) >= list.size()) return core::kNoId;
  return list[static_cast<std::size_t>(index)].id;
}

int seenId(const core::Step& step, const core::Pairing& p)
{
  if (p.isBlob) return step.blobs ? idAt(step.blobs->blobs, p.index) : core::kNoId;
  return step.landmarks ? idAt(step.landmarks->sightings, p.index) : core::kNoId;
}

std::size_t observationsOf(const core::Step& step)
{
  return (step.landmarks ? step.landmarks->sightings.size() : 0) +
         (step.blobs ? step.blobs->blobs.size() : 0) + step.lasers.size();
}
}  // namespace

bool Record::landmarksIdentified() const
{
  bool any = false;
  for (const PairingRow& p : pairings)
  {
    if (p.pairing.isBlob || p.pairing.outcome == core::Pairing::Outcome::kRejected) continue;
    if (p.seenId == core::kNoId || p.seenId != p.pairing.id) return false;
    any = true;
  }
  return any;
}

namespace
{
/// A step's own time, but later than the row before it, even where a log's clock stands still.
double risingTime(double time, double before)
{
  return time <= before + kSameInstant ? before + kApart : time;
}

/// The path that a filter believes at the end, its times those of the rows.
Trajectory finalPath(const core::Filter& filter, double start)
{
  Trajectory out;
  double before = start;
  for (const core::PathPose& p : filter.path())
    out.poses.push_back({before = risingTime(p.time, before), p.pose, true});
  return out;
}
}  // namespace

Recorder::Recorder(const core::Filter& filter, const Options& options)
    : filter_(&filter), options_(options)
{
}

void Recorder::begin(const core::Estimate& start)
{
  odometry_ = start.robot.mean;
  // A start whose time nobody knows is no instant of the log.
  if (!std::isfinite(start.time)) return;
  addRow(start.time, start);
  start_ = start.time;
}

void Recorder::accept(const core::Step& step, const core::Update& update)
{
  if (step.odometry) odometry_ = math::compose(odometry_, step.odometry->mean);
  scanPending_ = scanPending_ || lookedFor(step, update);
  record_.observations += observationsOf(step);
  record_.particles = std::max(record_.particles, update.diagnostics.particles);
  record_.close += static_cast<std::size_t>(update.diagnostics.close);
  addPairings(step, update);
  const bool sameInstant =
      !record_.rows.empty() && record_.rows.back().time >= step.time - kSameInstant;
  record_.steps.push_back(diagnosticsOf(step, update));
  if (step.odometry)
  {
    addRow(step.time, update.estimate);
    record_.steps.back().time = record_.rows.back().time;
  }
  else if (sameInstant)
    replaceRow(update.estimate);
  addLasers(step);
}

void Recorder::addRow(double time, const core::Estimate& estimate)
{
  if (!record_.rows.empty()) time = risingTime(time, record_.rows.back().time);
  record_.rows.push_back({time, estimate.robot, odometry_, scanPending_});
  scanPending_ = false;
  addTargets(estimate);
}

void Recorder::replaceRow(const core::Estimate& estimate)
{
  RobotRow& row = record_.rows.back();
  row.robot = estimate.robot;
  row.scan = row.scan || scanPending_;
  scanPending_ = false;
  for (auto& [_, track] : tracks_)
    if (!track.rows.empty() && track.rows.back().row + 1 == record_.rows.size())
      track.rows.pop_back();
  addTargets(estimate);
}

void Recorder::addTargets(const core::Estimate& estimate)
{
  for (const core::TargetEstimate& t : estimate.targets)
  {
    TargetTrack& track = tracks_[{!t.identified, t.id}];
    track.id = t.id;
    track.label = t.label;
    track.identified = t.identified;
    track.rows.push_back({record_.rows.size() - 1, t.pose, t.velocity, t.lastSeen});
  }
}

void Recorder::addPairings(const core::Step& step, const core::Update& update)
{
  for (const core::Pairing& p : update.pairings)
    record_.pairings.push_back({step.time, p, seenId(step, p)});
}

void Recorder::addLasers(const core::Step& step)
{
  if (!options_.keepLasers || step.lasers.empty() || record_.rows.empty()) return;
  const std::size_t row = record_.rows.size() - 1;
  if (!record_.lasers.empty() && record_.lasers.back().row < row &&
      !movedOn(record_.rows[record_.lasers.back().row].robot.mean, record_.rows[row].robot.mean))
    return;
  for (const auto& scan : step.lasers) record_.lasers.push_back({row, scan});
}

Record Recorder::takeRecord()
{
  record_.lasers = withoutTargets(record_);
  return std::move(record_);
}

void Recorder::finish(bool complete)
{
  record_.complete = complete;
  record_.path = finalPath(*filter_, start_);
  const core::Estimate last = filter_->estimate();
  record_.hasMap = last.landmarks != nullptr;
  if (last.landmarks)
    last.landmarks->visit([&](const core::LandmarkEstimate& m) { record_.landmarks.push_back(m); });
  int freeId = 0;
  std::set<int> taken;
  for (auto& [_, track] : tracks_)  // those with an identity come first, and keep it
  {
    if (track.rows.empty()) continue;
    if (!taken.insert(track.id).second)
    {
      while (taken.count(freeId) || tracks_.count({true, freeId})) ++freeId;
      taken.insert(track.id = freeId);
    }
    record_.targets.push_back(std::move(track));
  }
  tracks_.clear();
}
}  // namespace slamot::eval
