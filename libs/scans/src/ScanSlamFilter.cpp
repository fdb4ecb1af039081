#include <slamot/core/checkStep.h>
#include <slamot/scans/ScanSlamFilter.h>

#include <limits>

namespace slamot::scans
{
ScanSlamFilter::ScanSlamFilter(core::Params& params, const core::FilterContext& context)
    : ScanSlamFilter(Settings::from(params), context)
{
}

ScanSlamFilter::ScanSlamFilter(const Settings& settings, const core::FilterContext& context)
    : maxRange_(settings.maxRange), slam_(settings, context.starts.robotPose())
{
  estimate_.time = context.starts.time.value_or(-std::numeric_limits<double>::infinity());
  estimate_.robot = slam_.pose();
}

core::Update ScanSlamFilter::process(const core::Step& step)
{
  core::checkStep(step, estimate_.time);
  if (step.odometry)
    slam_.move(share_.next(*step.odometry, step.time));
  else if (std::isfinite(estimate_.time))
    slam_.wait(step.time - estimate_.time);
  const std::vector<Return> returns = returnsOf(step.lasers, maxRange_);
  if (!returns.empty())
  {
    if (slam_.match(returns).matched) share_.matched(step.time);
    slam_.insert(returns);
  }
  if (step.odometry) slam_.note(step.time);
  estimate_.time = step.time;
  estimate_.robot = slam_.pose();
  return {estimate_, {}, {}};
}
}  // namespace slamot::scans
