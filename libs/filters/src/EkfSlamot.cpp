#include <slamot/filters/EkfSlamot.h>

#include "ekf/Hypotheses.h"

namespace slamot::filters
{
namespace
{
std::unique_ptr<EkfSlamot::Engine> makeEngine(core::Params& params,
                                              const std::vector<core::FilterContext>& contexts,
                                              const ekf::Mates& mates)
{
  const ekf::Settings settings = ekf::Settings::from(
      params, params.section() == "slamot" ? ekf::Preset{"mht", true} : ekf::Preset{});
  return std::visit(
      [&](const auto& motion) -> std::unique_ptr<EkfSlamot::Engine>
      {
        auto one = std::make_unique<ekf::EngineOf<std::decay_t<decltype(motion)>>>(settings, motion,
                                                                                   contexts, mates);
        if (!settings.arrival) return one;
        return std::make_unique<ekf::Hypotheses>(settings, std::move(one));
      },
      models::targetMotionFrom(params, "constant-acceleration"));
}
}  // namespace

EkfSlamot::EkfSlamot(core::Params& params, const core::FilterContext& context)
    : engine_(makeEngine(params, {context}, {}))
{
}
EkfSlamot::~EkfSlamot() = default;

core::Update EkfSlamot::process(const core::Step& step)
{
  return engine_->process(0, step);
}
core::Estimate EkfSlamot::estimate() const
{
  return engine_->estimate(0);
}
core::RobotAndTarget EkfSlamot::robotAndTarget(int target) const
{
  return engine_->robotAndTarget(target);
}
core::Fusion EkfSlamot::fuse(const core::Evidence& evidence, const core::FusionOptions& options)
{
  return engine_->fuse(evidence, options);
}
void EkfSlamot::predictTarget(core::RobotAndTarget& other, double dt) const
{
  engine_->predictTarget(other, dt);
}

CentralizedEkf::CentralizedEkf(core::Params& params,
                               const std::vector<core::FilterContext>& contexts,
                               const std::string& mateLabel, const std::vector<int>& mateIds)
    : engine_(makeEngine(params, contexts, {mateLabel, mateIds}))
{
}
CentralizedEkf::~CentralizedEkf() = default;

core::Update CentralizedEkf::process(int robot, const core::Step& step)
{
  return engine_->process(robot, step);
}
core::Estimate CentralizedEkf::estimate(int robot) const
{
  return engine_->estimate(robot);
}
}  // namespace slamot::filters
