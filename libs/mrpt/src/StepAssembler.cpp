#include "StepAssembler.h"

#include <slamot/mrpt/timestamp.h>
#include "readMotion.h"
#include "readObservation.h"

#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <slamot/core/checkStep.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace slamot::mrpt
{
using ::mrpt::obs::CObservation;
using ::mrpt::obs::CObservationComment;
using ::mrpt::obs::CObservationOdometry;

namespace
{
constexpr double kLongestIncrement = 1e6;  // [m]

bool isStill(const Pose2D& p)
{
  return p.x == 0 && p.y == 0 && p.phi == 0;
}

bool isMoving(const ::mrpt::math::TTwist2D& v)
{
  return v.vx != 0 || v.vy != 0 || v.omega != 0;
}

// A robot of constant velocity over dt; the midpoint's heading is exact to third order in dt.
Pose2D integrate(const ::mrpt::math::TTwist2D& v, double dt)
{
  const double half = 0.5 * v.omega * dt;
  return {dt * (v.vx * std::cos(half) - v.vy * std::sin(half)),
          dt * (v.vx * std::sin(half) + v.vy * std::cos(half)), math::wrapToPi(v.omega * dt)};
}

bool holdsSightings(const core::Step& s)
{
  return s.landmarks || s.blobs || !s.lasers.empty();
}
}  // namespace

StepAssembler::StepAssembler(const std::string& path, const RawlogSource::Options& options,
                             const LogFacts* before, std::function<void(const Entry&)> onEntry)
    : reader_(std::make_unique<EntryReader>(path)),
      read_([this] { return reader_->next(); }),
      options_(options),
      before_(before),
      onEntry_(std::move(onEntry))
{
  if (before_ != nullptr) lastMotionTime_ = before_->restTime;
}

StepAssembler::StepAssembler(ReadEntry read, const RawlogSource::Options& options,
                             const LogFacts* before)
    : read_(std::move(read)), options_(options), before_(before)
{
  if (before_ != nullptr) lastMotionTime_ = before_->restTime;
}

const Entry* StepAssembler::peek()
{
  while (!entry_ && !ended_)
  {
    entry_ = read_();
    if (!entry_)
    {
      ended_ = true;
      break;
    }
    if (reader_) facts_.packed = reader_->packed();
    if (onEntry_) onEntry_(*entry_);
    const bool isComment = entry_->kind == Entry::Kind::kComment;
    if (isComment) facts_.comment = entry_->as<CObservationComment>()->text;  // MRPT keeps the last
    if (!isComment) ++facts_.entries;
    const bool isUnused = entry_->kind == Entry::Kind::kObservation && !entry_->parts[0].object;
    if (isComment || isUnused) entry_.reset();
  }
  return entry_ ? &*entry_ : nullptr;
}

void StepAssembler::take()
{
  current_ = std::move(*entry_);
  entry_.reset();
}

std::optional<core::Step> StepAssembler::next()
{
  if (!reader_) ended_ = false;
  while (peek() != nullptr)
    if (auto step = assemble())
    {
      check(*step);
      ++facts_.steps;
      facts_.dropped += static_cast<std::size_t>(step->dropped);
      return step;
    }
  return std::nullopt;
}

// What filters demand, now: so that a run does not end at its last step for it.
void StepAssembler::check(const core::Step& step) const
{
  if (step.odometry && std::hypot(step.odometry->mean.x, step.odometry->mean.y) > kLongestIncrement)
    current_.fail("the odometry makes no sense", "mend the log");
  try
  {
    core::checkStep(step, step.time);
  }
  catch (const core::Error& e)
  {
    throw core::Error(e.status(), current_.where() + ", " + e.what(), "");
  }
}

std::optional<core::Step> StepAssembler::assemble()
{
  const bool first = facts_.entries == 1;
  velocity_.reset();
  take();
  if (current_.kind == Entry::Kind::kActions)
  {
    facts_.hasFrames = true;
    return assemblePair();
  }
  if (current_.kind == Entry::Kind::kFrame)
  {
    facts_.hasFrames = true;
    facts_.beginsWithFrame = facts_.beginsWithFrame || first;
    if (first && !options_.useFirstFrame) return std::nullopt;
    core::Step step;
    std::optional<double> time;
    addFrame(step, time);
    if (!step.odometry && !holdsSightings(step)) return std::nullopt;
    setTime(step, time, false);
    if (first && isAtRest(step)) noteRest(time);
    applyModel(step);
    return step;
  }
  return assembleGroup();
}

std::optional<core::Step> StepAssembler::assemblePair()
{
  core::Step step;
  std::optional<double> actionTime;
  if (const auto movement = movementAmong(current_))
  {
    step.odometry = incrementOf(*movement, current_);
    actionTime = timeOf(movement->timestamp);
    if (movement->hasVelocities) setVelocity(movement->velocityLocal);
  }
  std::optional<double> time;
  const bool hasFrame = peek() != nullptr && entry_->kind == Entry::Kind::kFrame;
  if (hasFrame)
  {
    take();
    addFrame(step, time);
  }
  else if (peek() == nullptr && facts_.beginsWithFrame)
    return std::nullopt;
  const bool fromAction = !time;
  if (fromAction) time = actionTime;
  setTime(step, time, fromAction);
  if (facts_.steps == 0 && isAtRest(step)) noteRest(time);
  applyModel(step);
  return step;
}

void StepAssembler::addFrame(core::Step& step, std::optional<double>& time)
{
  const bool hasMovement = step.odometry.has_value();
  for (const Entry::Part& part : current_.parts)
  {
    const auto observation = std::dynamic_pointer_cast<const CObservation>(part.object);
    if (!observation) continue;
    // Beside a movement, odometry in a frame is the same again.
    const bool isSame =
        hasMovement && dynamic_cast<const CObservationOdometry*>(observation.get()) != nullptr;
    if (!isSame) add(step, *observation);
    if (!time) time = timeOf(observation->timestamp);
  }
}

std::optional<core::Step> StepAssembler::assembleGroup()
{
  core::Step step;
  const auto stamp = current_.as<CObservation>()->timestamp;
  const bool first = facts_.entries == 1;
  bool used = add(step, *current_.as<CObservation>());
  for (const Entry* e = peek(); e != nullptr; e = peek())
  {
    if (e->kind != Entry::Kind::kObservation) break;
    const auto observation = e->as<CObservation>();
    if (observation->timestamp != stamp) break;
    take();
    used = add(step, *observation) || used;
  }
  const auto time = timeOf(stamp);
  if (time) noteTime(*time);
  if (first && isAtRest(step)) noteRest(time);
  if (!used || (!step.odometry && !holdsSightings(step))) return std::nullopt;
  setTime(step, time, false);
  applyModel(step);
  return step;
}

bool StepAssembler::add(core::Step& step, const CObservation& observation)
{
  if (const auto* odometry = dynamic_cast<const CObservationOdometry*>(&observation))
    return addOdometry(step, *odometry);
  return addObservation(step, observation, current_, options_.sensor);
}

bool StepAssembler::addOdometry(core::Step& step, const CObservationOdometry& odometry)
{
  if (!odometryLabel_) odometryLabel_ = odometry.sensorLabel;
  if (*odometryLabel_ != odometry.sensorLabel) return false;
  const Pose2D pose = odometry.odometry.asTPose();
  if (!std::isfinite(pose.x + pose.y + pose.phi))
    current_.fail("the odometry is not a number", "mend the log");
  if (odometry.hasVelocities) setVelocity(odometry.velocityLocal);
  if (odometryPose_)
  {
    facts_.odometryFromPoses = true;
    if (!step.odometry) step.odometry.emplace();
    step.odometry->mean = math::compose(step.odometry->mean, math::between(*odometryPose_, pose));
  }
  else if (const auto time = timeOf(odometry.timestamp))
    lastMotionTime_ = time;
  odometryPose_ = pose;
  return true;
}

void StepAssembler::setVelocity(const ::mrpt::math::TTwist2D& v)
{
  if (!std::isfinite(v.vx + v.vy + v.omega))
    current_.fail("the odometry's velocity is not a number", "mend the log");
  velocity_ = v;
}

// Whether the step holds no motion: that at its time the robot was where it started.
bool StepAssembler::isAtRest(const core::Step& step) const
{
  return !step.odometry || (isStill(step.odometry->mean) && !(velocity_ && isMoving(*velocity_)));
}

// None where the config says that the log's times tell nothing.
std::optional<double> StepAssembler::timeOf(const ::mrpt::Clock::time_point& stamp) const
{
  return options_.stepPeriod > 0 ? std::nullopt : toSeconds(stamp);
}

void StepAssembler::noteRest(std::optional<double> time)
{
  facts_.beginsAtRest = true;
  facts_.restTime = time;
}

void StepAssembler::noteTime(double time)
{
  if (!facts_.firstTime) facts_.firstTime = time;
  if (facts_.firstPeriod == 0) facts_.firstPeriod = std::max(0.0, time - *facts_.firstTime);
  facts_.lastTime = time;
}

void StepAssembler::setTime(core::Step& step, std::optional<double> time, bool fromAction)
{
  if (time)
  {
    noteTime(*time);
    // Within one kind time must not go back; an action's clock may differ a little from a sensor's.
    double& latest = latest_[fromAction ? 1 : 0];
    if (*time < latest)
    {
      char what[96];
      std::snprintf(what, sizeof what, "time %.6f s follows %.6f s", *time, latest);
      current_.fail(what, "sort it with RawLogViewer (Re-sort by timestamp)");
    }
    latest = *time;
  }
  else if (before_ != nullptr && before_->firstTime)
    time = lastTime_ ? *lastTime_ : *before_->firstTime;
  else
    time = countedTime(step);
  step.time = lastTime_ ? std::max(*time, *lastTime_) : *time;
  lastTime_ = step.time;
}

// By a clock of our own the start is at zero, and so is what is seen there before any motion.
double StepAssembler::countedTime(const core::Step& step) const
{
  if (!lastTime_ && !step.odometry) return 0;
  const double period =
      options_.stepPeriod > 0 ? options_.stepPeriod : RawlogSource::kPeriodWithoutTimes;
  const double time = period * (std::round(lastTime_.value_or(0) / period) + 1);
  return std::round(time * 1e9) / 1e9;  // as result files have it
}

void StepAssembler::applyModel(core::Step& step)
{
  if (!step.odometry) return;
  facts_.moves = facts_.moves || !isStill(step.odometry->mean);
  facts_.hasVelocities = facts_.hasVelocities || (velocity_ && isMoving(*velocity_));
  double dt = lastMotionTime_ ? step.time - *lastMotionTime_ : 0;
  if (dt <= 0 && !lastMotionTime_ && before_ != nullptr) dt = before_->firstPeriod;
  lastMotionTime_ = step.time;
  if (before_ == nullptr) return;
  const bool velocitiesOnly = before_->hasVelocities && !before_->moves;
  if (velocitiesOnly && velocity_) step.odometry->mean = integrate(*velocity_, dt);
  if (!options_.odometry.fromLog && dt <= 0 && !isStill(step.odometry->mean))
    current_.fail("the robot moves in no time, so [odometer] noise = model can't tell how surely",
                  "mend the log's times, or use the log's covariance: noise = log");
  step.odometry = options_.odometry.apply(*step.odometry, dt);
}
}  // namespace slamot::mrpt
