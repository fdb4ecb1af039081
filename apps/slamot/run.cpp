#include <slamot/core/Error.h>
#include <slamot/core/FilterRegistry.h>
#include <slamot/eval/Alignment.h>
#include <slamot/eval/Recorder.h>
#include <slamot/fusion/mates.h>
#include <slamot/mrpt/RawlogSource.h>
#include <slamot/results/Report.h>
#include <slamot/results/ResultFolder.h>
#include <slamot/results/RunPlan.h>
#include <slamot/results/StepTimer.h>
#include <slamot/results/TruthFiles.h>
#include <slamot/results/hints.h>
#include <slamot/team/teamResults.h>
#include <slamot/window/LiveView.h>

#include <chrono>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <thread>

#include "Command.h"
#include "Progress.h"
#include "laserMaps.h"
#include "modules.h"
#include "salvage.h"
#include "sceneOf.h"

namespace slamot::apps
{
namespace
{
using core::Error;
using core::ExitStatus;

constexpr const char* kReport = "report.html";

struct RunCommand
{
  CommonOptions common;
  std::string config, dataset, align;
  bool salvage = false, view = false;
};

core::Config readConfig(const RunCommand& o)
{
  core::Config config = core::Config::load(o.config);
  for (const std::string& assignment : o.common.set) config.set(assignment);
  if (o.common.seedGiven) config.set("run", "seed", std::to_string(o.common.seed));
  if (!o.align.empty()) config.set("run", "align", o.align);
  if (config.has("team")) config.set("run", "method", team::methodAlone(config));
  return config;
}

std::unique_ptr<core::Filter> makeFilter(core::Config& config, const results::RunPlan& plan,
                                         int number, int threads, const eval::Truth& truth)
{
  core::FilterContext context = team::contextOf(plan.starts, number, plan.seed, threads);
  // The one method that is told the truth: the bound that others are held against.
  if (plan.method == "true-pose-target" && !truth.robot.empty())
    context.truePose = [&truth](double time)
    {
      const auto pose = truth.robot.at(time);
      return pose ? std::optional<Pose2D>(pose->pose) : std::nullopt;
    };
  const core::FilterRegistry& registry = core::FilterRegistry::instance();
  auto filter = registry.make(plan.method, config, context);
  auto others = registry.names();
  if (config.has("team")) others.push_back("dds");  // for the same robot live
  config.requireAllRead(others);
  return filter;
}

std::string configText(const RunCommand& o, const core::Config& config)
{
  std::string text = "// slamot run config.ini " + o.dataset;
  for (const std::string& plugin : o.common.plugins) text += " --plugin " + plugin;
  return text + "\n\n" + config.effectiveText();
}

void warn(const std::string& text)
{
  std::fprintf(stderr, "slamot: warning: %s\n", text.c_str());
}

/// One run, from the opened log to its result folder.
class Run
{
 public:
  explicit Run(const RunCommand& o)
      : o_(o),
        config_(readConfig(o)),
        method_(core::methodOf(config_)),
        folder_(o.common.output.empty() ? results::defaultFolder(method_, o.dataset)
                                        : o.common.output),
        source_(o.dataset, sourceOptions()),
        plan_(results::planRun(config_, source_.starts())),
        truth_(results::loadTruth(results::truthFolder(o.dataset))),
        mateLabel_(readMateLabel()),
        filter_(makeFilter(config_, plan_, number(), o.common.threads, truth_))
  {
    results::requirePlaceFor(folder_);
    if (o.view) view_ = openView();
  }

  ExitStatus execute()
  {
    fusion::WithoutMates source(source_, mateLabel_);
    results::StepTimer timer(source);
    eval::Recorder recorder(*filter_, {true});
    std::vector<core::Sink*> sinks = {&timer, &recorder};
    if (view_) sinks.push_back(view_.get());
    std::exception_ptr failure;
    bool wasInterrupted = false;
    try
    {
      Progress progress("steps", o_.common.quiet);
      const auto show = [&](std::size_t n, double share) { progress.update(n, share); };
      wasInterrupted = core::run(timer, *filter_, sinks, {&interrupted, show}).interrupted;
    }
    catch (...)
    {
      failure = std::current_exception();
    }
    eval::Record record = recorder.takeRecord();
    record.complete = record.complete && source_.truncation().empty();
    if (!record.steps.empty()) write(record, timer.timing());
    if (failure) std::rethrow_exception(failure);
    stayInView();
    return conclude(record, wasInterrupted);
  }

 private:
  mrpt::RawlogSource::Options sourceOptions()
  {
    mrpt::RawlogSource::Options options = mrpt::RawlogSource::Options::from(config_);
    options.salvage = o_.salvage;
    return options;
  }

  [[nodiscard]] std::unique_ptr<window::LiveView> openView() const
  {
    auto& open = *moduleFunction<window::OpenLiveView>("slamot-window", window::kOpenLiveView);
    results::RunInfo info;
    info.method = plan_.method, info.dataset = o_.dataset;
    return open(results::titleOf(info), *filter_);
  }
  /// Results are written; the end stays to be looked at.
  void stayInView()
  {
    if (view_ && view_->isOpen() && !interrupted && !o_.common.quiet)
      std::fprintf(stderr, "close the window, or press Ctrl-C, to end\n");
    while (view_ && view_->isOpen() && !interrupted)
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }

  // With a section [team] this is one robot of a team, alone: as slamot team with one log.
  [[nodiscard]] std::string readMateLabel()
  {
    return config_.has("team") ? fusion::TeamOptions::from(config_, plan_.seed).mateLabel : "";
  }
  [[nodiscard]] int number() const
  {
    const std::string name = std::filesystem::path(o_.dataset).stem().string();
    return config_.has("team") ? team::robotNumbers({name}).front() : 0;
  }

  void write(const eval::Record& record, const results::Timing& timing) const
  {
    eval::EvaluationOptions options;
    options.align = plan_.align;
    options.leverArm = plan_.leverArm;
    const eval::Evaluation evaluation = eval::evaluate(record, truth_, options);
    const results::RunInfo info{plan_.method, o_.dataset, plan_.seed, configText(o_, config_)};
    const results::RunView view{record, truth_, evaluation};
    std::string warning;
    const auto addPictures = [&](const std::string& folder)
    {
      const std::filesystem::path place(folder);
      mrpt::saveScene((place / "scene.3Dscene").string(),
                      sceneOf(results::titleOf(info), view, filter_->particles()));
      saveLaserMaps(folder, record);
      warning = results::writeReport((place / kReport).string(), info, view);
    };
    results::writeResult(folder_, info, record, evaluation, timing, addPictures);
    if (o_.common.quiet) return;
    if (!warning.empty()) warn(warning);
    for (const std::string& hint : results::hintsOf(record, plan_.method)) warn(hint);
    std::printf("%s on %s: %zu steps, %zu observations, %.2f s%s\n%s", plan_.method.c_str(),
                o_.dataset.c_str(), record.steps.size(), record.observations, timing.wallS,
                record.complete ? "" : ", incomplete",
                results::summaryTable(record, evaluation).c_str());
    std::printf("report: %s\n", (std::filesystem::path(folder_) / kReport).c_str());
  }

  [[nodiscard]] ExitStatus conclude(const eval::Record& record, bool wasInterrupted) const
  {
    if (wasInterrupted) return ExitStatus::kInterrupted;
    if (source_.truncation().empty()) return ExitStatus::kDone;
    tellSalvaged(source_.truncation(), record);
    return ExitStatus::kTruncated;
  }

  const RunCommand& o_;
  core::Config config_;
  std::string method_, folder_;
  mrpt::RawlogSource source_;
  results::RunPlan plan_;
  eval::Truth truth_;
  std::string mateLabel_;  // of blobs that the filter is not to see; empty: it sees all
  std::unique_ptr<core::Filter> filter_;
  std::unique_ptr<window::LiveView> view_;  // none: not asked for
};
}  // namespace

void addRun(CLI::App& app, int& status)
{
  auto o = std::make_shared<RunCommand>();
  CLI::App* command =
      app.add_subcommand("run",
                         "Run one filter over one rawlog and write a result folder.\n"
                         "Example: slamot run config-ini/rbpf-slamot.experiment1.ini "
                         "share/datasets/experiment1.rawlog");
  o->common.addTo(*command);
  command->get_option("--output")
      ->description("The result folder (default slamot-out/<method>-<dataset>)");
  command->add_option("config", o->config, "The configuration")
      ->required()
      ->type_name("CONFIG.ini");
  command
      ->add_option("dataset", o->dataset, "The log; truth in X.truth/, if any, is for the summary")
      ->required()
      ->type_name("X.rawlog");
  command->add_flag("--view", o->view, "Show the run in a window as it goes on; needs a display");
  command->add_flag("--salvage", o->salvage, "Use the intact first part of a truncated log");
  command
      ->add_option("--align", o->align,
                   "How errors lay the map over the truth (default none where the start is given, "
                   "else first-pose)")
      ->check(CLI::IsMember(eval::alignNames()));
  command->callback(
      [o, &status]
      {
        o->common.loadPlugins();
        status = static_cast<int>(Run(*o).execute());
      });
}
}  // namespace slamot::apps
