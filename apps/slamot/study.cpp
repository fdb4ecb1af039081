#include <slamot/core/Error.h>
#include <slamot/results/TextFile.h>
#include <slamot/study/execute.h>
#include <slamot/study/results.h>
#include <slamot/study/tables.h>

#include <cstdio>
#include <filesystem>

#include "Command.h"
#include "Progress.h"
#include "studyOptions.h"

namespace slamot::apps
{
namespace
{
namespace fs = std::filesystem;
using core::Error;
using core::ExitStatus;
constexpr const char* kAgain = "run the study again";

struct StudyCommand
{
  CommonOptions common;
  std::string study, shard;
  std::vector<std::string> merge;
};

std::string outputOf(const StudyCommand& o)
{
  if (!o.common.output.empty()) return o.common.output;
  if (o.merge.size() == 1) return o.merge.front();
  return (fs::path("slamot-out") / fs::path(o.study).stem()).string();
}

study::Plan planOf(const StudyCommand& o)
{
  auto set = o.common.set;
  if (o.common.seedGiven) set.push_back("study.first_seed=" + std::to_string(o.common.seed));
  return study::Plan(study::StudySpec::load(o.study, set));
}

void publish(const StudyCommand& o, const study::Plan& plan, const std::string& folder,
             const study::Outcome& outcome)
{
  study::saveSpec(folder, plan.spec);
  study::saveResults(folder, plan, outcome);
  if (!o.common.quiet)
    std::printf("%s\nresults: %s\n", study::tableMarkdown(plan, outcome).c_str(), folder.c_str());
}

ExitStatus merge(const StudyCommand& o, const study::Plan& plan)
{
  std::vector<std::string> folders;
  for (const std::string& folder : o.merge)
    for (const std::string& part : study::recordFolders(folder)) folders.push_back(part);
  const study::Outcome outcome = study::collect(plan, folders);
  noteStale(outcome.stale, "left out");
  if (outcome.missing == plan.runs.size())
    throw Error(ExitStatus::kNonsense, o.merge.front(), "holds no record of this study",
                "merge what this study's file, with the same --set, has made");
  publish(o, plan, outputOf(o), outcome);
  for (const auto& record : outcome.records)
    if (record && !record->error.empty())
      failRuns(o.merge.front(), outcome.failed, plan.runs.size(), *record, kAgain);
  return ExitStatus::kDone;
}

ExitStatus execute(const StudyCommand& o, const study::Plan& plan)
{
  study::ExecuteOptions options;
  if (!o.shard.empty()) readShard(o.shard, options);
  const std::string folder = outputOf(o);
  Progress progress("runs", o.common.quiet);
  options.threads = o.common.threads;
  options.stop = &interrupted;
  options.onProgress = [&](std::size_t done, std::size_t of, std::size_t)
  { progress.update(done, static_cast<double>(done) / static_cast<double>(of)); };
  const study::ExecuteResult result = study::execute(plan, folder, options);
  progress.finish();
  noteStale(result.stale, "made anew");
  if (!o.common.quiet)
    std::printf("%zu runs: %zu were there, %zu made\n", result.runs, result.found, result.made);
  // Shards may share the folder: each writes nothing but its own records.
  if (o.shard.empty()) publish(o, plan, folder, study::collect(plan, {folder}));
  if (result.interrupted)
  {
    std::fprintf(stderr, "slamot: interrupted; the same command goes on from here\n");
    return ExitStatus::kInterrupted;
  }
  if (result.firstFailed) failRuns(folder, result.failed, result.runs, *result.firstFailed, kAgain);
  return ExitStatus::kDone;
}
}  // namespace

void addStudy(CLI::App& app, int& status)
{
  auto o = std::make_shared<StudyCommand>();
  CLI::App* command = app.add_subcommand(
      "study",
      "Runs over seeds and parameter grids: tables and plots.  A rerun does only what is missing.\n"
      "Example: slamot study config-ini/study.rbpf-slamot.table1.ini --threads 2\n"
      "Spread:  parallel slamot study S.ini -o out --shard {}/8 ::: 1 2 3 4 5 6 7 8; "
      "slamot study S.ini --merge out");
  o->common.addTo(*command);
  command->get_option("--output")
      ->description("Where records, tables and plots go (default slamot-out/<study>)");
  command->get_option("--seed")->description("The first seed, in place of the study's");
  command->get_option("--threads")->description("Runs at a time; results do not depend on it");
  command->add_option("study", o->study, "The study, as config-ini/study.*.ini")
      ->required()
      ->type_name("STUDY.ini");
  auto* shard = command->add_option("--shard", o->shard,
                                    "Only every N-th run, the I-th of them; records, no tables");
  shard->type_name("I/N");
  command
      ->add_option(
          "--merge", o->merge,
          "Run nothing: tables and plots from the records in DIR, or in the folders in it; "
          "repeatable")
      ->type_name("DIR")
      ->allow_extra_args(false)
      ->excludes(shard);
  command->callback(
      [o, &status]
      {
        o->common.loadPlugins();
        const study::Plan plan = planOf(*o);
        status = static_cast<int>(o->merge.empty() ? execute(*o, plan) : merge(*o, plan));
      });
}
}  // namespace slamot::apps
