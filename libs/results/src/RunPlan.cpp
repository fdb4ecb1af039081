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

RunPlan planRun(core::Config& config, const core::Starts& ofLog)
{
  RunPlan plan;
  plan.method = core::methodOf(config);
  core::Params run(config, "run");
  plan.seed = readSeed(run);
  adoptStarts(config, ofLog);
  plan.starts = core::Starts::from(config);
  const eval::Align usual = plan.starts.robot ? eval::Align::kNone : eval::Align::kFirstPose;
  plan.align = *eval::alignNamed(run.choice("align", eval::alignNames(), eval::nameOf(usual)));
  return plan;
}
}  // namespace slamot::results
