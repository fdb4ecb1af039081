#include "rbpf/Engine.h"

namespace slamot::filters
{
namespace
{
rbpf::Preset presetOf(const std::string& name)
{
  const std::string unscented = "unscented", sampled = "sampled";
  if (name == "fastslam1") return {100, "motion", "nn"};
  if (name == "fastslam2") return {20, "informed", "nn"};
  if (name == "ufastslam") return {20, unscented, "nn", unscented, "landmarks", sampled};
  if (name == "gmphd-ufastslam") return {20, unscented, "nn", unscented, "gm-phd", sampled};
  return {};  // rbpf-slamot: the configuration chooses
}
}  // namespace

RbpfSlamot::RbpfSlamot(core::Params& params, const core::FilterContext& context)
{
  const rbpf::Settings settings = rbpf::Settings::from(params, presetOf(params.section()));
  engine_ = std::visit(
      [&](const auto& motion) -> std::unique_ptr<Engine>
      {
        return std::make_unique<rbpf::EngineOf<std::decay_t<decltype(motion)>>>(settings, motion,
                                                                                context);
      },
      models::targetMotionFrom(params));
}
RbpfSlamot::~RbpfSlamot() = default;

core::Update RbpfSlamot::process(const core::Step& step)
{
  return engine_->process(step);
}
core::Estimate RbpfSlamot::estimate() const
{
  return engine_->estimate();
}
std::vector<core::WeightedPose> RbpfSlamot::particles() const
{
  return engine_->particles();
}
std::vector<core::PathPose> RbpfSlamot::path() const
{
  return engine_->path();
}
core::RobotAndTarget RbpfSlamot::robotAndTarget(int target) const
{
  return engine_->robotAndTarget(target);
}
core::Fusion RbpfSlamot::fuse(const core::Evidence& evidence, const core::FusionOptions& options)
{
  return engine_->fuse(evidence, options);
}
void RbpfSlamot::predictTarget(core::RobotAndTarget& other, double dt) const
{
  engine_->predictTarget(other, dt);
}
std::size_t RbpfSlamot::mapBytes() const
{
  return engine_->mapBytes();
}
}  // namespace slamot::filters
