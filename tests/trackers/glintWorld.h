#pragma once

#include "drives.h"
#include "filterRig.h"

#include <slamot/sim/World.h>

#include <vector>

namespace slamot::test
{
/// A shipped scenario of one target under glint, with some keys changed, and what came of it.
struct GlintRun
{
  core::Starts starts;
  std::vector<core::Step> steps;
  std::vector<eval::TimedPose> truth;  ///< of the target: at the start, then after each step

  explicit GlintRun(const std::string& name, std::uint64_t seed = 1,
                    const std::vector<std::string>& changes = {})
  {
    core::Config config = core::Config::load(SLAMOT_CONFIG_INI "/sim.glint-" + name + ".ini");
    for (const std::string& change : changes) config.set(change);
    sim::World world(sim::Scenario::from(config), seed);
    starts = world.starts();
    while (auto step = world.next()) steps.push_back(std::move(*step));
    truth = world.truth().targets.at(1).poses;
  }

  [[nodiscard]] core::FilterContext context(std::uint64_t seed = 1, int threads = 1) const
  {
    core::FilterContext c;
    c.starts = starts;
    c.seed = seed;
    c.threads = threads;
    return c;
  }
};

/// Of the paper's motion, without gates.
inline const std::string kGlintKeys =
    "association = known\ntarget_velocity_std_mps = 10\ntarget_step_acceleration_std_mps2 = 0.1\n"
    "target_lost_std_m = 1e6\ntarget_lost_s = 1e6\n";
inline const std::string kPlaces = kGlintKeys + "observation = position\n";

inline std::string glint(double probability)
{
  return "target_glint_probability = " + std::to_string(probability) + "\n";
}

/// All the filter's target estimates, step by step.
inline std::vector<core::TargetEstimate> follow(core::Filter& filter, const GlintRun& run)
{
  std::vector<core::TargetEstimate> out;
  for (const core::Step& step : run.steps)
    out.push_back(filter.process(step).estimate.targets.at(0));
  return out;
}

/// RMSE of the place over steps.
inline double rmse(const std::vector<core::TargetEstimate>& estimates, const GlintRun& run)
{
  double sum = 0;
  for (std::size_t i = 0; i < estimates.size(); ++i)
  {
    const Pose2D &e = estimates[i].pose.mean, &t = run.truth[i + 1].pose;
    sum += (e.x - t.x) * (e.x - t.x) + (e.y - t.y) * (e.y - t.y);
  }
  return std::sqrt(sum / static_cast<double>(estimates.size()));
}
}  // namespace slamot::test
