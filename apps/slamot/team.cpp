#include <slamot/core/Error.h>
#include <slamot/core/FilterRegistry.h>
#include <slamot/eval/Alignment.h>
#include <slamot/eval/Recorder.h>
#include <slamot/mrpt/RawlogSource.h>
#include <slamot/results/ResultFolder.h>
#include <slamot/results/RunPlan.h>
#include <slamot/results/StepTimer.h>
#include <slamot/results/TextFile.h>
#include <slamot/results/TruthFiles.h>
#include <slamot/team/teamReport.h>

#include <cstdio>
#include <exception>
#include <filesystem>

#include "Command.h"
#include "Progress.h"
#include "memberResult.h"
#include "salvage.h"
#include "teamScene.h"

namespace slamot::apps
{
namespace
{
namespace fs = std::filesystem;
using core::Error;
using core::ExitStatus;

struct TeamCommand
{
  CommonOptions common;
  std::string config, align;
  std::vector<std::string> datasets;
  bool salvage = false;
};

/// One robot's log, and what came of it.
struct Robot
{
  Robot(const std::string& path, const mrpt::RawlogSource::Options& options)
      : dataset(path),
        name(fs::path(path).stem().string()),
        source(path, options),
        truth(results::loadTruth(results::truthFolder(path)))
  {
  }
  std::string dataset, name;
  mrpt::RawlogSource source;
  eval::Truth truth;
  std::unique_ptr<eval::Recorder> recorder;
  eval::Record record;
};

/// One run of a team, from the opened logs to its results.
class TeamRun
{
 public:
  explicit TeamRun(const TeamCommand& o) : o_(o), config_(core::Config::load(o.config))
  {
    for (const std::string& assignment : o.common.set) config_.set(assignment);
    if (o.common.seedGiven) config_.set("run", "seed", std::to_string(o.common.seed));
    if (!o.align.empty()) config_.set("run", "align", o.align);
    auto options = mrpt::RawlogSource::Options::from(config_);
    options.salvage = o.salvage;
    for (const std::string& path : o.datasets)
      robots_.push_back(std::make_unique<Robot>(path, options));
    requireNames();
    makeTeam();
    folder_ = o.common.output.empty()
                  ? results::defaultFolder("team-" + team_->options().ruleName, o.datasets.front())
                  : o.common.output;
    results::requirePlaceFor(folder_);
  }

  ExitStatus execute()
  {
    std::vector<std::vector<core::Sink*>> sinks;
    for (std::size_t r = 0; r < robots_.size(); ++r)
    {
      robots_[r]->recorder =
          std::make_unique<eval::Recorder>(team_->filter(r), eval::Recorder::Options{true});
      sinks.push_back({robots_[r]->recorder.get()});
    }
    results::StepTimer timer(robots_.front()->source);
    std::exception_ptr failure;
    bool wasInterrupted = false;
    try
    {
      Progress progress("steps", o_.common.quiet);
      const auto show = [&](std::size_t n, double share) { progress.update(n, share); };
      wasInterrupted = team_->run(sinks, {&interrupted, show}).interrupted;
    }
    catch (...)
    {
      failure = std::current_exception();
    }
    bool any = false;
    for (auto& robot : robots_)
    {
      robot->record = robot->recorder->takeRecord();
      robot->record.complete = robot->record.complete && robot->source.truncation().empty();
      any = any || !robot->record.steps.empty();
    }
    if (any) write(timer.timing());
    if (failure) std::rethrow_exception(failure);
    return wasInterrupted ? ExitStatus::kInterrupted : conclude();
  }

 private:
  [[nodiscard]] ExitStatus conclude() const
  {
    ExitStatus out = ExitStatus::kDone;
    for (const auto& robot : robots_)
    {
      if (robot->source.truncation().empty()) continue;
      tellSalvaged(robot->source.truncation(), robot->record);
      out = ExitStatus::kTruncated;
    }
    return out;
  }

  void requireNames() const
  {
    std::set<std::string> names;
    for (const auto& robot : robots_)
      if (!names.insert(robot->name).second)
        throw Error(ExitStatus::kConfig, robot->dataset, "a team has two logs of this name",
                    "give each robot's log once, under a name of its own");
  }

  void makeTeam()
  {
    plan_ = results::readSeedAndAlign(config_, startsAreKnown());
    std::vector<std::string> names;
    for (const auto& robot : robots_) names.push_back(robot->name);
    const auto numbers = team::robotNumbers(names);
    std::vector<team::Log> logs;
    for (std::size_t r = 0; r < robots_.size(); ++r)
      logs.push_back({numbers[r], &robots_[r]->source, robots_[r]->source.starts()});
    team_ = std::make_unique<team::Team>(config_, logs, plan_.seed, o_.common.threads);
    auto others = core::FilterRegistry::instance().names();
    others.push_back("dds");  // for the same robots live
    config_.requireAllRead(others);
  }

  [[nodiscard]] bool startsAreKnown() const
  {
    return std::all_of(robots_.begin(), robots_.end(),
                       [](const auto& r) { return r->source.starts().robot.has_value(); });
  }

  void write(const results::Timing& timing)
  {
    results::ResultFolder folder(folder_);
    const auto evaluations = evaluateTogether();
    std::string text = "// slamot team config.ini";
    for (const auto& robot : robots_) text += " " + robot->dataset;
    text += "\n\n" + config_.effectiveText();
    std::vector<team::RobotResult> all;
    for (std::size_t r = 0; r < robots_.size(); ++r)
    {
      Robot& robot = *robots_[r];
      const results::RunInfo info{team_->method(r), robot.dataset, plan_.seed, text};
      const results::RunView view{robot.record, robot.truth, evaluations[r]};
      const std::string place = (fs::path(folder.temporary()) / robot.name).string();
      writeMemberResult(place, info, view, team_->filter(r), timing, team_->events(r));
      all.push_back({robot.name, view});
    }
    const fs::path place(folder.temporary());
    results::writeWhole((place / "config.ini").string(), text);
    results::writeWhole((place / "team.json").string(),
                        team::teamJson(*team_, all, plan_.seed, timing));
    mrpt::saveScene((place / "scene.3Dscene").string(),
                    teamSceneOf(team::titleOf(*team_), team::viewOf(*team_, all)));
    const std::string warning =
        team::writeTeamReport((place / "report.html").string(), *team_, all, plan_.seed, text);
    folder.publish();
    if (o_.common.quiet) return;
    if (!warning.empty()) std::fprintf(stderr, "slamot: warning: %s\n", warning.c_str());
    for (std::size_t r = 0; r < robots_.size(); ++r)
      std::printf("%s, %s: %zu steps\n%s", robots_[r]->name.c_str(), team_->method(r).c_str(),
                  robots_[r]->record.steps.size(),
                  results::summaryTable(robots_[r]->record, evaluations[r]).c_str());
    std::printf("%s", team::teamTable(*team_, all).c_str());
    std::printf("report: %s\n", (fs::path(folder_) / "report.html").c_str());
  }

  /// All robots share one map frame, and are laid over the truth together, once.
  [[nodiscard]] std::vector<eval::Evaluation> evaluateTogether() const
  {
    eval::EvaluationOptions options;
    options.align = plan_.align;
    std::vector<eval::RunWithTruth> runs;
    for (const auto& robot : robots_) runs.push_back({&robot->record, &robot->truth});
    return eval::evaluateTogether(runs, options);
  }

  const TeamCommand& o_;
  core::Config config_;
  std::vector<std::unique_ptr<Robot>> robots_;
  results::SeedAndAlign plan_;
  std::unique_ptr<team::Team> team_;
  std::string folder_;
};
}  // namespace

void addTeam(CLI::App& app, int& status)
{
  auto o = std::make_shared<TeamCommand>();
  CLI::App* command = app.add_subcommand(
      "team",
      "Run several robots, each with its own filter, that exchange estimates.\n"
      "Example: slamot team config-ini/team-ci.ini team.robot0.rawlog team.robot1.rawlog");
  o->common.addTo(*command);
  command->get_option("--output")
      ->description("The result folder (default slamot-out/team-<rule>-<first dataset>)");
  command->add_option("config", o->config, "The configuration, with a section [team]")
      ->required()
      ->type_name("CONFIG.ini");
  command->add_option("datasets", o->datasets, "A log for each robot, X.robot<number>.rawlog")
      ->required()
      ->type_name("X.rawlog ...");
  command->add_flag("--salvage", o->salvage, "Use the intact first part of truncated logs");
  command
      ->add_option("--align", o->align,
                   "How errors lay the map over the truth, once for all (default none where all "
                   "starts are given, else first-pose)")
      ->check(CLI::IsMember(eval::alignNames()));
  command->callback(
      [o, &status]
      {
        o->common.loadPlugins();
        status = static_cast<int>(TeamRun(*o).execute());
      });
}
}  // namespace slamot::apps
