#include "trackers/Follower.h"
#include "trackers/KalmanBank.h"
#include "trackers/ParticleBank.h"

#include <slamot/core/checkStep.h>
#include <slamot/filters/Trackers.h>

#include <cmath>
#include <limits>

namespace slamot::filters
{
using trackers::Follower;

namespace
{
constexpr double kUsualGlint = 0.1;  // outliers' share in imm-tracker's law

std::unique_ptr<Follower> particleFollower(core::Params& p, const core::FilterContext& context)
{
  const auto settings = trackers::Settings::from(p);
  const auto options = trackers::ParticleBank::Options::from(p);
  // The one model that samples move by; named, as for other filters.
  p.choice("target_motion", {"constant-velocity"}, "constant-velocity");
  const models::ConstantVelocityTarget motion(models::ConstantVelocityTarget::Params::from(p));
  return std::make_unique<Follower>(
      settings, std::make_unique<trackers::ParticleBank>(options, motion, context), context.starts);
}

std::unique_ptr<Follower> kalmanFollower(core::Params& p, const core::FilterContext& context)
{
  const auto settings =
      trackers::Settings::from(p, p.section() == "imm-tracker" ? kUsualGlint : 0.0);
  auto bank = std::visit(
      [](const auto& motion) -> std::unique_ptr<trackers::Bank>
      { return std::make_unique<trackers::KalmanBank<std::decay_t<decltype(motion)>>>(motion); },
      models::targetMotionFrom(p, "constant-velocity"));
  return std::make_unique<Follower>(settings, std::move(bank), context.starts);
}
}  // namespace

Tracker::Tracker(const core::FilterContext& context, std::unique_ptr<Follower> follower)
    : follower_(std::move(follower))
{
  estimate_.time = context.starts.time.value_or(-std::numeric_limits<double>::infinity());
  estimate_.robot = context.starts.robotPose();
  estimate_.targets = follower_->estimates(estimate_.robot);
}
Tracker::~Tracker() = default;

core::Update Tracker::process(const core::Step& step)
{
  core::checkStep(step, estimate_.time);
  const double dt = std::isfinite(estimate_.time) ? step.time - estimate_.time : 0.0;
  estimate_.time = step.time;
  if (step.odometry) estimate_.robot = math::compose(estimate_.robot, *step.odometry);
  follower_->process(step, dt, estimate_.robot.mean);
  estimate_.targets = follower_->estimates(estimate_.robot);
  return {estimate_, follower_->pairings(), follower_->diagnostics()};
}

ParticleTracker::ParticleTracker(core::Params& params, const core::FilterContext& context)
    : Tracker(context, particleFollower(params, context))
{
}

KalmanTracker::KalmanTracker(core::Params& params, const core::FilterContext& context)
    : Tracker(context, kalmanFollower(params, context))
{
}
}  // namespace slamot::filters
