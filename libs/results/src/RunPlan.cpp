#include <slamot/core/FilterRegistry.h>
#include <slamot/eval/Alignment.h>
#include <slamot/results/RunPlan.h>

#include <charconv>

namespace slamot::results
{
namespace
{
void adoptStarts(core::Config& config, const core::Starts& ofLog)
{
  if (!config.has("start"))
    config.addMissingSections(core::Config::parse(ofLog.toIni(), "the log's start"));
  else if (ofLog.time && !config.has("start", "time_s"))
  {
    // When the log starts is a matter of the log, whoever says where.
    char digits[40];
    const auto end = std::to_chars(digits, digits + sizeof digits, *ofLog.time).ptr;
    config.set("start", "time_s", std::string(digits, end));
  }
}

std::uint64_t readSeed(core::Params& run)
{
  const std::string text = run.text("seed", "1");
  std::uint64_t seed = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seed);
  if (error != std::errc{} || end != text.data() + text.size())
    run.fail("seed", "'" + text + "' is no seed", "set it to a whole number from 0 on");
  return seed;
}
}  // namespace

SeedAndAlign readSeedAndAlign(core::Config& config, bool startsAreKnown)
{
  core::Params run(config, "run");
  SeedAndAlign out;
  out.seed = readSeed(run);
  const eval::Align usual = startsAreKnown ? eval::Align::kNone : eval::Align::kFirstPose;
  out.align = *eval::alignNamed(run.choice("align", eval::alignNames(), eval::nameOf(usual)));
  return out;
}

Point2D readLeverArm(core::Config& config)
{
  core::Params run(config, "run");
  const std::vector<double> arm = run.numbers("lever_arm_m", "0, 0");
  if (arm.size() != 2)
    run.fail("lever_arm_m", "is not two numbers", "write the point of the robot as X, Y");
  return {arm[0], arm[1]};
}

RunPlan planRun(core::Config& config, const core::Starts& ofLog)
{
  RunPlan plan;
  plan.method = core::methodOf(config);
  adoptStarts(config, ofLog);
  plan.starts = core::Starts::from(config);
  const SeedAndAlign run = readSeedAndAlign(config, plan.starts.robot.has_value());
  plan.seed = run.seed;
  plan.align = run.align;
  plan.leverArm = readLeverArm(config);
  return plan;
}
}  // namespace slamot::results
