#include "rbpf/TargetFollower.h"

#include <slamot/core/Error.h>
#include <slamot/core/checkStep.h>
#include <slamot/filters/Baselines.h>
#include <slamot/filters/RbpfSlamot.h>

#include <cmath>
#include <limits>

namespace slamot::filters
{
using rbpf::TargetFollower;

namespace
{
core::Estimate firstEstimate(const core::Starts& starts)
{
  core::Estimate e;
  e.time = starts.time.value_or(-std::numeric_limits<double>::infinity());
  e.robot = starts.robotPose();
  return e;
}

double elapsed(const core::Step& step, const core::Estimate& last)
{
  return std::isfinite(last.time) ? step.time - last.time : 0.0;
}
}  // namespace

OdometryTarget::OdometryTarget(core::Params& params, const core::FilterContext& context)
    : follower_(TargetFollower::make(params, context.starts)),
      estimate_(firstEstimate(context.starts))
{
  estimate_.targets = follower_->estimates(estimate_.robot);
}
OdometryTarget::~OdometryTarget() = default;

core::Update OdometryTarget::process(const core::Step& step)
{
  core::checkStep(step, estimate_.time);
  const double dt = elapsed(step, estimate_);
  estimate_.time = step.time;
  if (step.odometry) estimate_.robot = math::compose(estimate_.robot, *step.odometry);
  follower_->process(step, dt, estimate_.robot.mean);
  estimate_.targets = follower_->estimates(estimate_.robot);
  return {estimate_, follower_->pairings(), {}};
}

TruePoseTarget::TruePoseTarget(core::Params& params, const core::FilterContext& context)
    : truePose_(context.truePose),
      follower_(TargetFollower::make(params, context.starts)),
      estimate_(firstEstimate(context.starts))
{
  if (!truePose_)
    throw core::Error(core::ExitStatus::kConfig, "true-pose-target",
                      "the robot's true path is missing",
                      "put robot.tum into the log's .truth folder");
  estimate_.targets = follower_->estimates(estimate_.robot);
}
TruePoseTarget::~TruePoseTarget() = default;

core::Update TruePoseTarget::process(const core::Step& step)
{
  core::checkStep(step, estimate_.time);
  const std::optional<Pose2D> pose = truePose_(step.time);
  if (!pose && step.blobs && !step.blobs->blobs.empty())
    throw core::Error(core::ExitStatus::kNonsense, "step at " + std::to_string(step.time) + " s",
                      "the true path does not reach it", "use a log within its truth");
  const double dt = elapsed(step, estimate_);
  estimate_.time = step.time;
  if (pose)
    estimate_.robot = {*pose, Matrix3::Zero()};
  else if (step.odometry)
    estimate_.robot = math::compose(estimate_.robot, *step.odometry);
  follower_->process(step, dt, estimate_.robot.mean);
  estimate_.targets = follower_->estimates(estimate_.robot);
  return {estimate_, follower_->pairings(), {}};
}

Independent::Independent(core::Params& params, const core::FilterContext& context)
    : follower_(TargetFollower::make(params, context.starts))
{
  core::FilterContext slamOnly = context;
  slamOnly.starts.targets.clear();
  slam_ = std::make_unique<RbpfSlamot>(params, slamOnly);
  estimate_ = slam_->estimate();
  estimate_.targets = follower_->estimates(estimate_.robot);
}
Independent::~Independent() = default;

core::Update Independent::process(const core::Step& step)
{
  core::checkStep(step, estimate_.time);
  const double dt = elapsed(step, estimate_);
  core::Step slamOnly = step;
  slamOnly.blobs.reset();
  core::Update update = slam_->process(slamOnly);
  follower_->process(step, dt, update.estimate.robot.mean);
  update.estimate.targets = follower_->estimates(update.estimate.robot);
  const auto& blobs = follower_->pairings();
  update.pairings.insert(update.pairings.end(), blobs.begin(), blobs.end());
  estimate_ = update.estimate;
  return update;
}
}  // namespace slamot::filters
