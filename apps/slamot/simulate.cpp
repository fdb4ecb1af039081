#include <slamot/core/Error.h>
#include <slamot/mrpt/RawlogWriter.h>
#include <slamot/results/TruthFiles.h>
#include <slamot/sim/World.h>

#include <cstdio>
#include <deque>
#include <filesystem>

#include "Command.h"
#include "TeamLogs.h"
#include "pictureObservation.h"
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
  std::string format = "frames", images = "inside";
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

mrpt::RawlogWriter openLog(const std::string& path, const sim::World& world,
                           const SimulateOptions& o)
{
  using Format = mrpt::RawlogWriter::Format;
  return {path, o.format == "frames" ? Format::kActionFrames : Format::kObservations,
          world.starts()};
}

struct Tally
{
  std::size_t steps = 0, scans = 0, images = 0;
};

/// All steps of a world; none if interrupted.
std::optional<Tally> writeSteps(sim::World& world, mrpt::RawlogWriter& writer,
                                const sim::RobotSetup& robot, const ImagesBeside& images,
                                const SimulateOptions& o)
{
  const ImagesBeside* const beside = o.images == "beside" ? &images : nullptr;
  Tally out;
  while (const auto step = world.next())
  {
    if (interrupted) return std::nullopt;
    std::vector<std::shared_ptr<::mrpt::obs::CObservation>> pictures;
    if (const auto picture = world.picture())
      pictures.push_back(pictureObservation(*picture, *robot.camera, step->time, beside));
    writer.write(*step, pictures);
    ++out.steps;
    out.images += pictures.size();
    if (step->landmarks || !step->lasers.empty()) ++out.scans;
  }
  return out;
}

void report(const std::string& path, const Tally& tally, const eval::Truth& truth)
{
  const std::string images = tally.images > 0 ? ", " + count(tally.images, "image") : "";
  std::printf("%s: %s, %s%s, %s, %s; truth in %s\n", path.c_str(),
              count(tally.steps, "step").c_str(), count(tally.scans, "scan").c_str(),
              images.c_str(), count(truth.landmarks.size(), "landmark").c_str(),
              count(truth.targets.size(), "target").c_str(), results::truthFolder(path).c_str());
}

// Logs are as the sensor puts them out: what lies out of its view is for the reader to drop.
constexpr auto kRaw = sim::World::Sightings::kRaw;

ExitStatus simulateOne(const sim::Scenario& scenario, const std::string& output,
                       const SimulateOptions& o)
{
  sim::World world(scenario, o.common.seed, kRaw);
  const std::string path = rawlogOutput(output);
  ImagesBeside images(path);
  mrpt::RawlogWriter writer = openLog(path, world, o);
  const auto tally = writeSteps(world, writer, scenario.robots[0], images, o);
  if (!tally) return ExitStatus::kInterrupted;
  results::saveTruth(results::truthFolder(path), world.truth());
  images.place();
  writer.close();
  if (!o.common.quiet) report(path, *tally, world.truth());
  return ExitStatus::kDone;
}

ExitStatus simulateTeam(const sim::Scenario& scenario, const std::string& output,
                        const SimulateOptions& o)
{
  TeamLogs logs(output);
  std::vector<Tally> tallies;
  std::deque<ImagesBeside> images;
  for (int robot = 0; robot < static_cast<int>(scenario.robots.size()); ++robot)
    images.emplace_back(logs.pathOf(robot));
  for (int robot = 0; robot < static_cast<int>(scenario.robots.size()); ++robot)
  {
    sim::World world(scenario, o.common.seed, kRaw, robot);
    mrpt::RawlogWriter writer = openLog(logs.partOf(robot), world, o);
    const auto tally = writeSteps(world, writer, scenario.robots[std::size_t(robot)],
                                  images[std::size_t(robot)], o);
    if (!tally) return ExitStatus::kInterrupted;
    writer.close();
    logs.add(robot, world.truth());
    tallies.push_back(*tally);
  }
  for (ImagesBeside& beside : images) beside.place();
  logs.place();
  for (std::size_t i = 0; i < tallies.size() && !o.common.quiet; ++i)
    report(logs.pathOf(int(i)), tallies[i], logs.truth(int(i)));
  return ExitStatus::kDone;
}

int simulate(const SimulateOptions& o)
{
  const sim::Scenario scenario = readScenario(o);
  const std::string output = o.common.output.empty() ? defaultOutput(o.scenario) : o.common.output;
  const bool alone = scenario.robots.size() == 1;
  return static_cast<int>(alone ? simulateOne(scenario, output, o)
                                : simulateTeam(scenario, output, o));
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
          "The rawlog, X.rawlog; truth goes to X.truth/; several robots: X.robot0.rawlog, ... "
          "(default slamot-out/<scenario>.rawlog)")
      ->type_name("X.rawlog");
  command->add_option("scenario", options->scenario, "The scenario, as config-ini/sim.*.ini")
      ->required()
      ->type_name("SCENARIO.ini");
  command
      ->add_option("--format", options->format,
                   "frames: pairs of action and sensory frame; observations: observations only")
      ->check(CLI::IsMember({"frames", "observations"}));
  command
      ->add_option(
          "--images", options->images,
          "inside: the log holds them; beside: as files in X_Images, in place of older ones")
      ->check(CLI::IsMember({"inside", "beside"}));
  command->callback([options, &status] { status = simulate(*options); });
}
}  // namespace slamot::apps
