#include <slamot/core/Error.h>
#include <slamot/mrpt/RawlogWriter.h>
#include <slamot/results/TruthFiles.h>
#include <slamot/sim/World.h>

#include <cstdio>
#include <filesystem>

#include "Command.h"
#include "rawlogOutput.h"

namespace slamot::apps
{
namespace
{
namespace fs = std::filesystem;
using core::ExitStatus;

struct SimulateOptions
{
  CommonOptions common;
  std::string scenario;
  std::string format = "frames";
};

// sim.<name>.ini goes to slamot-out/<name>.rawlog.
std::string defaultOutput(const std::string& scenarioPath)
{
  std::string name = fs::path(scenarioPath).stem().string();
  if (name.rfind("sim.", 0) == 0) name.erase(0, 4);
  return (fs::path("slamot-out") / (name + ".rawlog")).string();
}

sim::Scenario readScenario(const SimulateOptions& o)
{
  core::Config config = core::Config::load(o.scenario);
  for (const std::string& assignment : o.common.set) config.set(assignment);
  const sim::Scenario scenario = sim::Scenario::from(config);
  config.requireAllRead();
  return scenario;
}

int simulate(const SimulateOptions& o)
{
  // As the sensor puts them out: what lies out of its view is for the reader to drop.
  sim::World world(readScenario(o), o.common.seed, sim::World::Sightings::kRaw);
  const std::string path =
      rawlogOutput(o.common.output.empty() ? defaultOutput(o.scenario) : o.common.output);
  using Format = mrpt::RawlogWriter::Format;
  mrpt::RawlogWriter writer(
      path, o.format == "frames" ? Format::kActionFrames : Format::kObservations, world.starts());
  std::size_t steps = 0, scans = 0;
  while (const auto step = world.next())
  {
    if (interrupted) return static_cast<int>(ExitStatus::kInterrupted);
    writer.write(*step);
    ++steps;
    if (step->landmarks) ++scans;
  }
  const std::string truth = results::truthFolder(path);
  results::saveTruth(truth, world.truth());
  writer.close();
  if (!o.common.quiet)
    std::printf("%s: %s, %s, %s, %s; truth in %s\n", path.c_str(), count(steps, "step").c_str(),
                count(scans, "scan").c_str(),
                count(world.truth().landmarks.size(), "landmark").c_str(),
                count(world.truth().targets.size(), "target").c_str(), truth.c_str());
  return static_cast<int>(ExitStatus::kDone);
}
}  // namespace

void addSimulate(CLI::App& app, int& status)
{
  auto options = std::make_shared<SimulateOptions>();
  CLI::App* command = app.add_subcommand(
      "simulate",
      "Write a rawlog and its ground truth from a scenario.\n"
      "Example: slamot simulate config-ini/sim.experiment1.ini -o experiment1.rawlog");
  options->common.addTo(*command);
  command->get_option("--output")
      ->description(
          "The rawlog, X.rawlog; truth goes to X.truth/ "
          "(default slamot-out/<scenario>.rawlog)")
      ->type_name("X.rawlog");
  command->add_option("scenario", options->scenario, "The scenario, as config-ini/sim.*.ini")
      ->required()
      ->type_name("SCENARIO.ini");
  command
      ->add_option("--format", options->format,
                   "frames: pairs of action and sensory frame; observations: observations only")
      ->check(CLI::IsMember({"frames", "observations"}));
  command->callback([options, &status] { status = simulate(*options); });
}
}  // namespace slamot::apps
