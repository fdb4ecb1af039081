#include <slamot/core/checkStep.h>
#include <slamot/scans/ScanSlamotFilter.h>

#include <cmath>
#include <limits>

namespace slamot::scans
{
namespace
{
/// By beam of all lasers, one after another.
template <class MaskOf>
std::vector<bool> maskOfAll(const core::Step& step, const MaskOf& maskOf)
{
  std::vector<bool> out;
  for (const auto& laser : step.lasers)
  {
    const std::vector<bool> mask = maskOf(*laser);
    out.insert(out.end(), mask.begin(), mask.end());
  }
  return out;
}
}  // namespace

ScanSlamotFilter::ScanSlamotFilter(core::Params& params, const core::FilterContext& context)
    : settings_(Settings::from(params)),
      objects_(moving::MovingOptions::from(params), context.starts)
{
  if (params.choice("ego", {"scans", "odometry"}, "scans") == "scans")
    slam_.emplace(settings_, context.starts.robotPose());
  estimate_.time = context.starts.time.value_or(-std::numeric_limits<double>::infinity());
  estimate_.robot = context.starts.robotPose();
  estimate_.targets = objects_.targets(estimate_.robot);
}

std::vector<core::PathPose> ScanSlamotFilter::path() const
{
  return slam_ ? slam_->path() : std::vector<core::PathPose>{};
}

void ScanSlamotFilter::moveBy(const core::Step& step, double dt)
{
  const auto motion =
      step.odometry ? share_.next(*step.odometry, step.time) : blindMotion(blind_, dt, settings_);
  blind_ = step.odometry ? 0 : blind_ + dt;
  objects_.move(motion, dt);
  if (!slam_)
    estimate_.robot = math::compose(estimate_.robot, motion);
  else if (step.odometry)
    slam_->move(motion);
  else
    slam_->wait(dt);
}

void ScanSlamotFilter::matchStanding(const std::vector<Return>& returns, const core::Step& step)
{
  const std::vector<bool> expected =
      maskOfAll(step, [&](const core::LaserScan& scan) { return objects_.expected(scan); });
  std::vector<Return> standing;
  for (const Return& r : returns)
    if (!expected[r.beam]) standing.push_back(r);
  if (standing.empty()) return;
  const Pose2D before = slam_->pose().mean;
  if (slam_->match(standing).matched) share_.matched(step.time), blind_ = 0;
  objects_.move({math::between(before, slam_->pose().mean), Matrix3::Zero()}, 0);
}

core::Update ScanSlamotFilter::process(const core::Step& step)
{
  core::checkStep(step, estimate_.time);
  moveBy(step, std::isfinite(estimate_.time) ? step.time - estimate_.time : 0);
  const std::vector<Return> returns = returnsOf(step.lasers, settings_.maxRange);
  if (slam_ && !returns.empty()) matchStanding(returns, step);
  const std::vector<bool> moving =
      maskOfAll(step, [&](const core::LaserScan& scan) { return objects_.see(step.time, scan); });
  if (slam_)
  {
    if (!returns.empty()) slam_->insert(returns, moving);
    if (step.odometry) slam_->note(step.time);
    estimate_.robot = slam_->pose();
  }
  estimate_.time = step.time;
  estimate_.targets = objects_.targets(estimate_.robot);
  return {estimate_, {}, {}};
}
}  // namespace slamot::scans
