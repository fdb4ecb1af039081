#include <slamot/study/Trial.h>

#include <slamot/core/FilterRegistry.h>
#include <slamot/core/Odometry.h>
#include <slamot/mrpt/RawlogSource.h>
#include <slamot/results/TruthFiles.h>
#include <slamot/sim/World.h>

#include "hash.h"

namespace slamot::study
{
namespace
{
using mrpt::RawlogSource;

/// Sets the values of the axes in a file that has the sections they are for.
core::Config configOf(const ConfigFile& file, const StudySpec& spec, const Cell& cell)
{
  core::Config out = file.config();
  for (std::size_t a = 0; a < spec.axes.size(); ++a)
    for (const std::string& key : spec.axes[a].keys)
    {
      const auto dot = key.find_last_of('.');
      const std::string section = key.substr(0, dot);
      if (out.has(section))
        out.set(section, key.substr(dot + 1), spec.axes[a].values[cell.values[a]]);
    }
  return out;
}

/// A world, its odometry as uncertain as the method takes it to be.
class ModelledWorld : public core::Source
{
 public:
  ModelledWorld(const sim::Scenario& scenario, std::uint64_t seed, const core::OdometryModel& model)
      : world_(scenario, seed), dt_(scenario.dt), model_(model)
  {
  }

  std::optional<core::Step> next() override
  {
    auto step = world_.next();
    if (step && step->odometry) step->odometry = model_.apply(*step->odometry, dt_);
    return step;
  }
  [[nodiscard]] double progress() const override { return world_.progress(); }
  [[nodiscard]] const core::Starts& starts() const { return world_.starts(); }
  [[nodiscard]] const eval::Truth& truth() const { return world_.truth(); }

 private:
  sim::World world_;
  double dt_;
  core::OdometryModel model_;
};

core::Starts openWorld(const StudySpec& spec, const Cell& cell, std::uint64_t seed,
                       const core::OdometryModel& odometry, Trial& trial)
{
  core::Config config = configOf(spec.scenario, spec, cell);
  const auto scenario = sim::Scenario::from(config);
  config.requireAllRead();
  auto world = std::make_unique<ModelledWorld>(scenario, seed, odometry);
  trial.truth = [w = world.get()]() -> const eval::Truth& { return w->truth(); };
  trial.effective = config.effectiveText();
  core::Starts starts = world->starts();
  trial.source = std::move(world);
  return starts;
}

core::Starts openRawlog(const std::string& path, const RawlogSource::Options& options, Trial& trial)
{
  auto log = std::make_unique<RawlogSource>(path, options);
  const std::string folder = results::truthFolder(path);
  auto truth = std::make_shared<const eval::Truth>(results::loadTruth(folder));
  trial.truth = [truth]() -> const eval::Truth& { return *truth; };
  trial.effective = hashOfFiles(path, folder);
  core::Starts starts = log->starts();
  trial.source = std::move(log);
  return starts;
}

eval::Align alignOf(const std::string& name, const core::Starts& starts)
{
  if (name == "none") return eval::Align::kNone;
  if (name == "first-pose") return eval::Align::kFirstPose;
  if (name == "rigid") return eval::Align::kRigid;
  return starts.robot ? eval::Align::kNone : eval::Align::kFirstPose;
}

/// A config's own [start] takes the place of the data's, but for the time.
core::Starts startsOf(core::Config& config, const core::Starts& ofData)
{
  if (!config.has("start")) return ofData;
  core::Starts out = core::Starts::from(config);
  if (!out.time) out.time = ofData.time;
  return out;
}

// As `slamot run` accepts them; in a study, seed and alignment are the study's.
void readRunSection(core::Config& config)
{
  core::Params run(config, "run");
  run.text("seed", "1");
  run.text("align", "auto");
}
}  // namespace

Trial openTrial(const StudySpec& spec, const Cell& cell, const Method& method, std::uint64_t seed)
{
  Trial trial;
  core::Config config = configOf(method.file, spec, cell);
  const std::string name = core::methodOf(config);
  const auto options = RawlogSource::Options::from(config);
  readRunSection(config);
  core::FilterContext context;
  context.starts =
      startsOf(config, spec.simulated ? openWorld(spec, cell, seed, options.odometry, trial)
                                      : openRawlog(spec.rawlogs[cell.rawlog], options, trial));
  context.seed = seed;
  // The one method that is told the truth: the bound that others are held against.
  if (name == "true-pose-target")
    context.truePose = [truth = trial.truth](double time) -> std::optional<Pose2D>
    {
      const auto pose = truth().robot.at(time);
      if (!pose) return std::nullopt;
      return pose->pose;
    };
  trial.filter = core::FilterRegistry::instance().make(name, config, context);
  config.requireAllRead(core::FilterRegistry::instance().names());
  trial.evaluation.align = alignOf(spec.align, context.starts);
  trial.effective += config.effectiveText() + "align = " + spec.align;
  return trial;
}
}  // namespace slamot::study
