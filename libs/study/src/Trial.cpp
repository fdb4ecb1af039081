#include <slamot/study/Trial.h>

#include <slamot/core/Error.h>
#include <slamot/core/FilterRegistry.h>
#include <slamot/core/Odometry.h>
#include <slamot/mrpt/RawlogSource.h>
#include <slamot/results/RunPlan.h>
#include <slamot/results/TruthFiles.h>
#include <slamot/sim/World.h>
#include <slamot/sim/posteriorBound.h>

#include "hash.h"
#include "tableText.h"

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
    for (std::size_t k = 0; k < spec.axes[a].keys.size(); ++k)
    {
      const std::string& key = spec.axes[a].keys[k];
      const auto dot = key.find_last_of('.');
      const std::string section = key.substr(0, dot);
      if (out.has(section))
        out.set(section, key.substr(dot + 1), spec.axes[a].settings[cell.values[a]][k]);
    }
  return out;
}

/// A world, its odometry as uncertain as the method takes it to be.
class ModelledWorld : public core::Source
{
 public:
  ModelledWorld(const sim::Scenario& scenario, std::uint64_t seed, const core::OdometryModel& model,
                int robot)
      : world_(scenario, seed, sim::World::Sightings::kAsRead, robot),
        dt_(scenario.dt),
        model_(model)
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

BoundFigures::Figure meanOf(const std::vector<sim::PosteriorBound::Figure>& figures)
{
  BoundFigures::Figure out;
  for (const auto& f : figures)
  {
    out.bound += f.bound / static_cast<double>(figures.size());
    out.efficient += f.efficient / static_cast<double>(figures.size());
  }
  return out;
}

BoundFigures figuresOf(const sim::PosteriorBound& bound)
{
  std::vector<sim::PosteriorBound::Figure> positions, headings, targets;
  for (const auto& robot : bound.robots)
    positions.push_back(robot.position), headings.push_back(robot.heading);
  for (const auto& [id, figure] : bound.targets) targets.push_back(figure);
  BoundFigures out;
  out.robotPosition = meanOf(positions);
  out.robotHeading = meanOf(headings);
  if (bound.map) out.map = meanOf({*bound.map});
  if (!targets.empty()) out.target = meanOf(targets);
  return out;
}

void openWorld(const StudySpec& spec, const Cell& cell, std::uint64_t seed, bool isTeam,
               const core::OdometryModel& odometry, Trial& trial)
{
  core::Config config = configOf(spec.scenario, spec, cell);
  const auto scenario = sim::Scenario::from(config);
  config.requireAllRead();
  trial.effective = config.effectiveText();
  const std::size_t robots = isTeam ? scenario.robots.size() : 1;
  for (std::size_t r = 0; r < robots; ++r)
  {
    auto world = std::make_unique<ModelledWorld>(scenario, seed, odometry, static_cast<int>(r));
    Trial::Robot robot;
    robot.truth = [w = world.get()]() -> const eval::Truth& { return w->truth(); };
    robot.starts = world->starts();
    robot.source = std::move(world);
    trial.robots.push_back(std::move(robot));
  }
  trial.world =
      trial.effective + "seed = " + std::to_string(seed) + "\nrobots = " + std::to_string(robots);
  if (!spec.bound) return;
  trial.bound = [scenario, seed, robots]() -> std::optional<BoundFigures>
  {
    const auto bound = sim::posteriorBound(scenario, seed, static_cast<int>(robots));
    if (!bound) return std::nullopt;
    return figuresOf(*bound);
  };
}

void openRawlog(const std::string& path, const RawlogSource::Options& options, Trial& trial)
{
  auto log = std::make_unique<RawlogSource>(path, options);
  const std::string folder = results::truthFolder(path);
  auto truth = std::make_shared<const eval::Truth>(results::loadTruth(folder));
  trial.effective = hashOfFiles(path, folder);
  core::Starts starts = log->starts();
  trial.robots.push_back(
      {std::move(log), [truth]() -> const eval::Truth& { return *truth; }, starts});
}

/// Whether errors are those that the bound is of: in the map's frame, as the scenario tells it.
bool isBoundComparable(const core::Config& config, const Trial& trial)
{
  const core::Starts& starts = trial.robots[0].starts;
  const bool isExact = starts.robotPose().cov.isZero(0);
  const eval::Align align = trial.evaluation.align;
  return !config.has("start") && trial.evaluation.leverArm == Point2D() &&
         (align == eval::Align::kNone || (align == eval::Align::kFirstPose && isExact));
}

/// How runs are judged, which their metrics depend on.
std::string judging(const StudySpec& spec)
{
  return "align = " + spec.align + "\ncutoffs = " + shortest(spec.landmarkCutoff) + ", " +
         shortest(spec.gospaCutoff) + "\nbound = " + (spec.bound ? "true" : "false") +
         (spec.timeBins > 0 ? "\ntime_bins = " + std::to_string(spec.timeBins) : "");
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
void readRunSection(core::Config& config, eval::EvaluationOptions& evaluation)
{
  core::Params run(config, "run");
  run.text("seed", "1");
  run.text("align", "auto");
  evaluation.leverArm = results::readLeverArm(config);
}
}  // namespace

namespace
{
void makeFilter(core::Config& config, std::uint64_t seed, Trial& trial)
{
  const std::string name = core::methodOf(config);
  core::FilterContext context;
  context.starts = trial.robots[0].starts = startsOf(config, trial.robots[0].starts);
  context.seed = seed;
  // The one method that is told the truth: the bound that others are held against.
  if (name == "true-pose-target")
    context.truePose = [truth = trial.robots[0].truth](double time) -> std::optional<Pose2D>
    {
      const auto pose = truth().robot.at(time);
      if (!pose) return std::nullopt;
      return pose->pose;
    };
  trial.filter = core::FilterRegistry::instance().make(name, config, context);
}

void makeTeam(core::Config& config, std::uint64_t seed, Trial& trial)
{
  std::vector<team::Log> logs;
  for (std::size_t r = 0; r < trial.robots.size(); ++r)
    logs.push_back({static_cast<int>(r), trial.robots[r].source.get(), trial.robots[r].starts});
  trial.team = std::make_unique<team::Team>(config, logs, seed, 1);
}
}  // namespace

Trial openTrial(const StudySpec& spec, const Cell& cell, const Method& method, std::uint64_t seed)
{
  Trial trial;
  core::Config config = configOf(method.file, spec, cell);
  const auto options = RawlogSource::Options::from(config);
  const bool isTeam = config.has("team");
  readRunSection(config, trial.evaluation);
  if (isTeam && !spec.simulated)
    throw core::Error(core::ExitStatus::kConfig, method.file.name + " [team]",
                      "a study of a team needs a scenario", "use slamot team for rawlogs");
  if (spec.simulated)
    openWorld(spec, cell, seed, isTeam, options.odometry, trial);
  else
    openRawlog(spec.rawlogs[cell.rawlog], options, trial);
  if (isTeam)
    makeTeam(config, seed, trial);
  else
    makeFilter(config, seed, trial);
  config.requireAllRead(core::FilterRegistry::instance().names());
  trial.evaluation.align = alignOf(spec.align, trial.robots[0].starts);
  if (!isBoundComparable(config, trial)) trial.bound = nullptr;
  trial.evaluation.landmarkCutoff = spec.landmarkCutoff;
  trial.evaluation.gospaCutoff = spec.gospaCutoff;
  trial.timeBins = spec.timeBins;
  trial.effective += config.effectiveText() + judging(spec);
  return trial;
}
}  // namespace slamot::study
