#include <slamot/core/Error.h>
#include <slamot/reproduce/Reproduction.h>

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
using reproduce::Reproduction;
constexpr const char* kAgain = "reproduce again";

struct ReproduceCommand
{
  CommonOptions common;
  std::string name, shard, configs;
  bool isQuick = false;
  std::vector<std::string> merge;
};

/// Where the reproductions are: here, as from a checkout, or with the program, installed or built.
std::string configFolder(const ReproduceCommand& o)
{
  if (!o.configs.empty()) return o.configs;
  std::vector<fs::path> places = {"config-ini"};
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error).parent_path();
  if (!error)
  {
    places.push_back(program / "../share/slamot/config-ini");
    places.push_back(program / "../../../config-ini");
  }
  for (const fs::path& place : places)
    if (fs::is_regular_file(place / "reproduce.all.ini")) return place.lexically_normal().string();
  return "config-ini";
}

std::string outputOf(const ReproduceCommand& o)
{
  if (!o.common.output.empty()) return o.common.output;
  if (o.merge.size() == 1) return o.merge.front();
  fs::path out = fs::path("slamot-out") / (o.isQuick ? "reproduction-quick" : "reproduction");
  // All papers have folders of their own in it, and share them with the paper alone.
  if (o.name != "all") out /= fs::path(o.name).stem().string();
  return out.string();
}

Reproduction reproductionOf(const ReproduceCommand& o)
{
  Reproduction::Options options;
  options.isQuick = o.isQuick;
  options.set = o.common.set;
  if (o.common.seedGiven) options.firstSeed = o.common.seed;
  return {o.name, configFolder(o), options};
}

[[noreturn]] void failFirst(const Reproduction& all, const std::string& folder)
{
  std::size_t runs = 0;
  const study::RunRecord* first = nullptr;
  for (const auto& s : all.studies())
  {
    runs += s.plan->runs.size();
    for (const auto& record : s.outcome.records)
      if (record && !record->error.empty() && !first) first = &*record;
  }
  failRuns(folder, all.failed(), runs, *first, kAgain);
}

ExitStatus interruptedHere()
{
  std::fprintf(stderr, "slamot: interrupted; the same command goes on from here\n");
  return ExitStatus::kInterrupted;
}

/// Pictures, tables and the page, from the records that are there.
ExitStatus publish(const ReproduceCommand& o, Reproduction& all, const std::string& folder,
                   const std::vector<std::string>& records)
{
  all.collect(records);
  if (!all.draw(folder, &interrupted)) return interruptedHere();
  const std::string warning = all.publish(folder);
  if (!warning.empty()) std::fprintf(stderr, "slamot: %s\n", warning.c_str());
  if (!o.common.quiet) std::printf("page: %s/reproduction.html\n", folder.c_str());
  if (all.failed() > 0) failFirst(all, folder);
  return ExitStatus::kDone;
}

ExitStatus merge(const ReproduceCommand& o, Reproduction& all)
{
  all.collect(o.merge);
  std::size_t stale = 0, runs = 0;
  for (const auto& s : all.studies()) stale += s.outcome.stale, runs += s.plan->runs.size();
  noteStale(stale, "left out");
  if (runs > 0 && all.missing() == runs)
    throw Error(ExitStatus::kNonsense, o.merge.front(), "holds no record of this reproduction",
                "merge what the same command, with the same --quick and --set, has made");
  return publish(o, all, outputOf(o), o.merge);
}

ExitStatus execute(const ReproduceCommand& o, Reproduction& all)
{
  study::ExecuteOptions options;
  if (!o.shard.empty()) readShard(o.shard, options);
  const std::string folder = outputOf(o);
  Progress progress("runs", o.common.quiet);
  options.threads = o.common.threads;
  options.stop = &interrupted;
  options.onProgress = [&](std::size_t done, std::size_t of, std::size_t)
  { progress.update(done, static_cast<double>(done) / static_cast<double>(of)); };
  const auto results = study::execute(all.jobs(folder), options);
  progress.finish();
  study::ExecuteResult sum;
  for (const auto& r : results)
  {
    sum.runs += r.runs, sum.found += r.found, sum.made += r.made;
    sum.stale += r.stale, sum.failed += r.failed;
    sum.interrupted = sum.interrupted || r.interrupted;
    if (!sum.firstFailed) sum.firstFailed = r.firstFailed;
  }
  noteStale(sum.stale, "made anew");
  if (!o.common.quiet)
    std::printf("%zu runs: %zu were there, %zu made\n", sum.runs, sum.found, sum.made);
  if (sum.interrupted) return interruptedHere();
  // Shards may share the folder: each writes nothing but its own records.
  if (o.shard.empty()) return publish(o, all, folder, {folder});
  if (sum.firstFailed) failRuns(folder, sum.failed, sum.runs, *sum.firstFailed, kAgain);
  return ExitStatus::kDone;
}

void addOptions(CLI::App& command, const std::shared_ptr<ReproduceCommand>& o)
{
  o->common.addTo(command);
  command.get_option("--output")
      ->description(
          "Where records, tables and the page go (default slamot-out/reproduction, or "
          "reproduction-quick, of one paper the folder of its name therein)");
  command.get_option("--seed")->description("The first seed, in place of the studies'");
  command.get_option("--set")->description("Override a value of the reproduction; repeatable");
  command.get_option("--threads")->description("Runs at a time; results do not depend on it");
  command
      .add_option("name", o->name,
                  "All papers or one, by the name of its reproduce.NAME.ini; or such a file")
      ->required()
      ->type_name("NAME|PAPER.ini:{all,rbpf-slamot,ekf-slamot-ci,fastslam-family,glint}");
  command.add_flag("--quick", o->isQuick, "Few seeds and a part of the cells: minutes, not hours");
  command.add_option("--configs", o->configs, "Where reproduce.NAME.ini is (default config-ini)")
      ->type_name("DIR");
  auto* shard =
      command.add_option("--shard", o->shard, "Only every N-th run, the I-th of them; no page");
  shard->type_name("I/N");
  command
      .add_option("--merge", o->merge,
                  "Run nothing: the page from the records in DIR, the --output of shards; "
                  "repeatable")
      ->type_name("DIR")
      ->allow_extra_args(false)
      ->excludes(shard);
}
}  // namespace

void addReproduce(CLI::App& app, int& status)
{
  auto o = std::make_shared<ReproduceCommand>();
  CLI::App* command = app.add_subcommand(
      "reproduce",
      "Repeat papers: their tables and figures beside the published ones, and a verdict on each "
      "claim.\n"
      "One page; a rerun does only what is missing.\n"
      "Example: slamot reproduce all --quick --threads 2\n"
      "Spread:  parallel slamot reproduce all -o out --shard {}/8 ::: 1 2 3 4 5 6 7 8; "
      "slamot reproduce all --merge out");
  addOptions(*command, o);
  command->callback(
      [o, &status]
      {
        o->common.loadPlugins();
        Reproduction all = reproductionOf(*o);
        status = static_cast<int>(o->merge.empty() ? execute(*o, all) : merge(*o, all));
      });
}
}  // namespace slamot::apps
