#include <slamot/core/Error.h>
#include <slamot/core/FilterRegistry.h>
#include <slamot/dds/CycloneNetwork.h>
#include <slamot/eval/Alignment.h>
#include <slamot/eval/Recorder.h>
#include <slamot/live/runLive.h>
#include <slamot/mrpt/RawlogSource.h>
#include <slamot/results/ResultFolder.h>
#include <slamot/results/RunPlan.h>
#include <slamot/results/StepTimer.h>
#include <slamot/results/TruthFiles.h>
#include <slamot/team/Team.h>
#include <slamot/team/liveResults.h>
#include <slamot/team/teamResults.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>

#include "Command.h"
#include "Progress.h"
#include "memberResult.h"

namespace slamot::apps
{
namespace
{
namespace fs = std::filesystem;
using core::Error;
using core::ExitStatus;

struct RobotCommand
{
  CommonOptions common;
  std::string config, dataset, align, team;
  std::optional<int> number;
  std::optional<double> wait;  // [s]
  bool lockstep = false;
  live::RealTimeOptions timing;
};

void printFusion(const fusion::FusionEvent& e)
{
  std::fprintf(stderr, "slamot: %.2f s: message of robot %d, %.2f s: %s\n", e.time,
               e.receipt.sender, e.sent, fusion::name(e.receipt.outcome));
}

/// One live run, from the opened log to its result folder.
class LiveRun
{
 public:
  explicit LiveRun(const RobotCommand& o)
      : o_(o),
        config_(core::Config::load(o.config)),
        source_(o.dataset, sourceOptions()),
        truth_(results::loadTruth(results::truthFolder(o.dataset))),
        plan_(results::readSeedAndAlign(config_, source_.starts().robot.has_value())),
        network_(dds::DdsOptions::from(config_)),
        team_(fusion::TeamOptions::from(config_, plan_.seed))
  {
    makeRobot();
    config_.requireAllRead(core::FilterRegistry::instance().names());
    folder_ = o.common.output.empty() ? results::defaultFolder("robot-" + team_.ruleName, o.dataset)
                                      : o.common.output;
    results::requirePlaceFor(folder_);
  }

  ExitStatus execute()
  {
    results::StepTimer timer(source_);
    eval::Recorder recorder(*filter_, {true});
    robot_ = {&source_, filter_.get(), member_.get(), {&recorder}, {}};
    std::exception_ptr failure;
    live::LiveResult result;
    try
    {
      result = run();
    }
    catch (...)
    {
      failure = std::current_exception();
    }
    const eval::Record record = recorder.takeRecord();
    if (!record.steps.empty()) write(record, timer.timing(), result.sessionsHeard);
    if (failure) std::rethrow_exception(failure);
    return result.interrupted ? ExitStatus::kInterrupted : ExitStatus::kDone;
  }

 private:
  mrpt::RawlogSource::Options sourceOptions()
  {
    for (const std::string& assignment : o_.common.set) config_.set(assignment);
    if (o_.common.seedGiven) config_.set("run", "seed", std::to_string(o_.common.seed));
    if (!o_.align.empty()) config_.set("run", "align", o_.align);
    if (!o_.team.empty()) config_.set("dds", "team", o_.team);
    return mrpt::RawlogSource::Options::from(config_);
  }

  void makeRobot()
  {
    number_ = o_.number ? *o_.number : numberInName();
    const auto& all = network_.team;
    const auto place = std::find(all.begin(), all.end(), number_);
    if (place == all.end())
      throw Error(ExitStatus::kConfig, config_.name() + " [dds] team",
                  "has no robot " + std::to_string(number_),
                  "name all robots of the team, this one too");
    if (team_.centralized)
      throw Error(ExitStatus::kConfig, config_.name() + " [team] rule",
                  "is centralized, which needs all logs in one process",
                  "use slamot team for that");
    const auto index = static_cast<std::size_t>(place - all.begin());
    method_ = team::methodsOf(config_, all.size())[index];
    auto made =
        team::makeFilter(config_, method_,
                         team::contextOf(source_.starts(), number_, plan_.seed, o_.common.threads));
    live_.team = {all.begin(), all.end()};
    live_.session = static_cast<std::uint64_t>(live::wallTime() * 1e6);
    member_ =
        std::make_unique<fusion::Member>(number_, live_.team, *made.asMember, team_, live_.session);
    filter_ = std::move(made.filter);
  }

  [[nodiscard]] int numberInName() const
  {
    const auto number = team::numberIn(fs::path(o_.dataset).stem().string());
    if (number) return *number;
    throw Error(ExitStatus::kConfig, o_.dataset, "its name tells no robot's number",
                "name it X.robot<number>.rawlog or give --number");
  }

  live::LiveResult run()
  {
    dds::CycloneNetwork network(number_, network_);
    fusion::Radio radio(team_.radio);
    Progress progress("steps", o_.common.quiet);
    live_.run = {&interrupted, [&](std::size_t n, double share) { progress.update(n, share); }};
    live_.onNews = [&](const std::string& text)
    {
      if (o_.common.quiet) return;
      progress.finish();
      std::fprintf(stderr, "slamot: %s\n", text.c_str());
    };
    if (o_.common.verbose) live_.onFusion = printFusion;
    if (o_.lockstep)
      return live::runLockstep(
          robot_, radio, network, live_,
          {o_.wait.value_or(live::LockstepOptions().waitS), network_.silenceS});
    live::RealTimeOptions timing = o_.timing;
    timing.waitS = o_.wait.value_or(0);
    timing.maxAge = team_.maxAge;
    return live::runRealTime(robot_, radio, network, live_, timing);
  }

  void write(const eval::Record& record, const results::Timing& timing,
             const std::map<int, int>& sessions) const
  {
    eval::EvaluationOptions options;
    options.align = plan_.align;
    const eval::Evaluation evaluation = eval::evaluate(record, truth_, options);
    const std::string text = "// slamot robot config.ini " + o_.dataset +
                             (o_.lockstep ? " --lockstep" : "") + " --number " +
                             std::to_string(number_) + "\n\n" + config_.effectiveText();
    const results::RunInfo info{method_, o_.dataset, plan_.seed, text};
    const results::RunView view{record, truth_, evaluation};
    writeMemberResult(folder_, info, view, *filter_, timing, robot_.events,
                      team::messagesJson(*member_, sessions));
    if (o_.common.quiet) return;
    std::printf("%s on %s, robot %d: %zu steps%s\n%s", method_.c_str(), o_.dataset.c_str(), number_,
                record.steps.size(), record.complete ? "" : ", incomplete",
                results::summaryTable(record, evaluation).c_str());
    std::printf("messages: %lld sent, %lld received, %zu good\nresults: %s\n",
                static_cast<long long>(member_->sent()),
                static_cast<long long>(member_->counts().messages()), robot_.events.size(),
                folder_.c_str());
  }

  const RobotCommand& o_;
  core::Config config_;
  mrpt::RawlogSource source_;
  eval::Truth truth_;
  results::SeedAndAlign plan_;
  dds::DdsOptions network_;
  fusion::TeamOptions team_;
  int number_ = 0;
  std::string method_, folder_;
  std::unique_ptr<core::Filter> filter_;
  std::unique_ptr<fusion::Member> member_;
  live::LiveOptions live_;
  fusion::TeamRobot robot_;
};

void addTiming(CLI::App& command, RobotCommand& o)
{
  live::RealTimeOptions& timing = o.timing;
  command.add_option("--speed", timing.speed, "Replay so many times as fast (default 1)")
      ->check(CLI::Range(1e-3, 1e6))
      ->type_name("FACTOR");
  command
      .add_option("--start-at", timing.startAt,
                  "When the team's clock begins, in seconds since 1970 (default at once, or where "
                  "others are)")
      ->type_name("WALLTIME");
  command
      .add_option("--clock-zero", timing.clockZero,
                  "What time in the log it is then [s] (default that of the log's first step)")
      ->type_name("LOGTIME");
  command
      .add_option("--wait", o.wait,
                  "Wait until all hear each other before the clock begins [s], at most (default 0; "
                  "60 with --lockstep)")
      ->check(CLI::Range(0.0, 1e6))
      ->type_name("SECONDS");
}
}  // namespace

void addRobot(CLI::App& app, int& status)
{
  auto o = std::make_shared<RobotCommand>();
  CLI::App* command = app.add_subcommand(
      "robot",
      "Run one robot of a team, live in its own process, exchanging messages over DDS.\n"
      "Example: slamot robot config-ini/team-ci.ini team.robot0.rawlog --team 0,1");
  o->common.addTo(*command);
  command->get_option("--output")
      ->description("The result folder (default slamot-out/robot-<rule>-<dataset>)");
  command->add_option("config", o->config, "The configuration, with sections [team] and [dds]")
      ->required()
      ->type_name("CONFIG.ini");
  command->add_option("dataset", o->dataset, "This robot's log, X.robot<number>.rawlog")
      ->required()
      ->type_name("X.rawlog");
  command->add_option("--team", o->team, "Numbers of all robots, in place of [dds] team")
      ->type_name("N,N,...");
  command->add_option("--number", o->number, "This robot's, in place of that in the log's name")
      ->check(CLI::Range(0, 999'999))
      ->type_name("N");
  command->add_flag("--lockstep", o->lockstep,
                    "Step by step with the others, by the logs' clock: results as slamot team's");
  addTiming(*command, *o);
  for (const char* name : {"--speed", "--start-at", "--clock-zero"})
    command->get_option("--lockstep")->excludes(command->get_option(name));
  command
      ->add_option("--align", o->align,
                   "How errors lay the map over the truth (default none where the start is given, "
                   "else first-pose)")
      ->check(CLI::IsMember(eval::alignNames()));
  command->callback(
      [o, &status]
      {
        o->common.loadPlugins();
        status = static_cast<int>(LiveRun(*o).execute());
      });
}
}  // namespace slamot::apps
