#include <slamot/core/checkStep.h>
#include <slamot/moving/LaserSlamot.h>

#include <limits>

namespace slamot::moving
{
LaserSlamot::LaserSlamot(core::Params& params, const core::FilterContext& context)
    : objects_(MovingOptions::from(params), context.starts)
{
  estimate_.time = context.starts.time.value_or(-std::numeric_limits<double>::infinity());
  estimate_.robot = context.starts.robotPose();
}

core::Update LaserSlamot::process(const core::Step& step)
{
  core::checkStep(step, estimate_.time);
  const double dt = std::isfinite(estimate_.time) ? step.time - estimate_.time : 0;
  estimate_.time = step.time;
  if (step.odometry) estimate_.robot = math::compose(estimate_.robot, *step.odometry);
  objects_.move(step.odometry.value_or(Gaussian<Pose2D>{}), dt);
  for (const auto& laser : step.lasers) objects_.see(step.time, *laser);
  estimate_.targets = objects_.targets(estimate_.robot);
  return {estimate_, {}, {}};
}
}  // namespace slamot::moving
