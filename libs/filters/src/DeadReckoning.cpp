#include <slamot/core/checkStep.h>
#include <slamot/filters/DeadReckoning.h>

#include <limits>

namespace slamot::filters
{
DeadReckoning::DeadReckoning(core::Params&, const core::FilterContext& context)
{
  estimate_.time = context.starts.time.value_or(-std::numeric_limits<double>::infinity());
  estimate_.robot = context.starts.robotPose();
}

core::Update DeadReckoning::process(const core::Step& step)
{
  core::checkStep(step, estimate_.time);
  estimate_.time = step.time;
  if (step.odometry) estimate_.robot = math::compose(estimate_.robot, *step.odometry);
  return {estimate_, {}, {}};
}
}  // namespace slamot::filters
