#include <slamot/core/Error.h>
#include <slamot/core/Params.h>
#include <slamot/eval/Alignment.h>
#include <slamot/results/RecordFiles.h>
#include <slamot/results/RunPlan.h>
#include <slamot/results/Summary.h>
#include <slamot/results/TextFile.h>
#include <slamot/results/TruthFiles.h>
#include <slamot/team/savedTeam.h>

#include <charconv>
#include <cstdio>
#include <filesystem>

#include "Command.h"
#include "laserMaps.h"
#include "savedRun.h"
#include "scanMapAlong.h"

namespace slamot::apps
{
namespace
{
namespace fs = std::filesystem;
using core::Error;
using core::ExitStatus;

struct EvaluateCommand
{
  CommonOptions common;  // of which only plugins make sense here
  std::string result, truth, scans, align, output;
  std::vector<double> leverArm;
  bool json = false;
  eval::EvaluationOptions options;
};

eval::Truth truthOf(const std::string& result, const std::string& prefix)
{
  auto truth = findTruth(result, prefix);
  if (!truth)
    throw Error(ExitStatus::kConfig, "evaluate " + result, "which truth it goes with is not known",
                "give --truth PREFIX");
  if (!isEmpty(*truth)) return std::move(*truth);
  const auto summary = results::loadSummary(result);
  throw Error(ExitStatus::kUnreadable, prefix.empty() && summary ? summary->dataset : prefix,
              "there is no truth", "give --truth the path of X.truth or X.rawlog");
}

// A file named target_<id>.tum is held against that target, in the robot's place.
void takeTargetForRobot(const std::string& file, eval::Truth& truth)
{
  const std::string name = fs::path(file).stem().string();
  int id = 0;
  if (name.rfind("target_", 0) != 0) return;
  std::from_chars(name.data() + 7, name.data() + name.size(), id);
  if (const auto it = truth.targets.find(id); it != truth.targets.end()) truth.robot = it->second;
}

// As the run was evaluated, unless told otherwise.
eval::EvaluationOptions optionsOf(const EvaluateCommand& o)
{
  eval::EvaluationOptions out = o.options;
  const eval::EvaluationOptions saved = savedOptions(o.result);
  out.align = saved.align, out.leverArm = saved.leverArm;
  if (!o.align.empty()) out.align = *eval::alignNamed(o.align);
  if (!o.leverArm.empty()) out.leverArm = {o.leverArm[0], o.leverArm[1]};
  return out;
}

void tell(const EvaluateCommand& o, const std::string& json, const std::string& table)
{
  if (!o.output.empty()) results::writeWhole(o.output, json);
  std::printf("%s", o.json ? json.c_str() : table.c_str());
}

std::string tableOf(const std::string& name, const eval::Record& record, const eval::Evaluation& e)
{
  return name + " (align " + eval::nameOf(e.align) + ")\n" + results::summaryTable(record, e, true);
}

eval::Record recordIn(const std::string& folder)
{
  eval::Record record = results::loadRecord(folder);
  loadLasers(folder, record);
  return record;
}

// With scans there is something to tell without a truth too.
eval::Truth truthOf(const EvaluateCommand& o)
{
  if (o.scans.empty() || !o.truth.empty()) return truthOf(o.result, o.truth);
  return findTruth(o.result, o.scans).value_or(eval::Truth());
}

// The robots of a team share one map frame: they are aligned together, once.
int evaluateTeam(EvaluateCommand o, const std::vector<std::string>& names)
{
  if (!o.truth.empty() && names.size() > 1)
    throw Error(ExitStatus::kConfig, "command line --truth",
                "is of one robot, but " + o.result + " is of a team",
                "leave it out, or evaluate a robot's folder in it");
  if (!o.scans.empty())
    throw Error(ExitStatus::kConfig, "command line --scans",
                "is of one robot, but " + o.result + " is of a team",
                "leave it out, or evaluate a robot's folder in it");
  std::vector<eval::Record> records;
  std::vector<eval::Truth> truths;
  for (const std::string& name : names)
  {
    const std::string folder = (fs::path(o.result) / name).string();
    records.push_back(recordIn(folder));
    truths.push_back(truthOf(folder, o.truth));
  }
  o.options = optionsOf(o);
  std::vector<eval::RunWithTruth> runs;
  for (std::size_t r = 0; r < names.size(); ++r) runs.push_back({&records[r], &truths[r]});
  const auto evaluations = eval::evaluateTogether(runs, o.options);
  std::vector<std::string> each;
  std::string table;
  for (std::size_t r = 0; r < names.size(); ++r)
  {
    each.push_back(results::evaluationJson(records[r], evaluations[r]));
    table += tableOf((fs::path(o.result) / names[r]).string(), records[r], evaluations[r]);
  }
  tell(o, team::evaluationsJson(names, each), table);
  return static_cast<int>(ExitStatus::kDone);
}

int evaluate(EvaluateCommand o)
{
  o.common.loadPlugins();
  const bool isFolder = fs::is_directory(o.result);
  if (!isFolder && !fs::exists(o.result))
    throw Error(ExitStatus::kUnreadable, o.result, "is not there",
                "give a result folder or a TUM file");
  if (const auto names = team::robotsIn(o.result); !names.empty())
    return evaluateTeam(std::move(o), names);
  const eval::Record record = isFolder ? recordIn(o.result) : results::loadTumRecord(o.result);
  eval::Truth truth = truthOf(o);
  if (!isFolder) takeTargetForRobot(o.result, truth);
  o.options = optionsOf(o);
  eval::Evaluation evaluation = eval::evaluate(record, truth, o.options);
  if (!o.scans.empty()) evaluation.scanMap = scanMapAlong(record, o.scans, o.result);
  tell(o, results::evaluationJson(record, evaluation), tableOf(o.result, record, evaluation));
  return static_cast<int>(ExitStatus::kDone);
}
}  // namespace

void addEvaluate(CLI::App& app, int& status)
{
  auto o = std::make_shared<EvaluateCommand>();
  CLI::App* command = app.add_subcommand(
      "evaluate",
      "Errors and consistency of a result folder, also a team's, or a TUM file, against truth.\n"
      "Example: slamot evaluate slamot-out/rbpf-slamot-experiment1 --align rigid");
  command->add_option("result", o->result, "A result folder or a TUM file")
      ->required()
      ->type_name("RESULT");
  command
      ->add_option("--truth", o->truth,
                   "X.truth or X.rawlog (default: of the log that the result, or --scans, is of)")
      ->type_name("PREFIX");
  command
      ->add_option("--scans", o->scans,
                   "Draw this log's laser scans along the path, and tell how sharp their map is")
      ->type_name("X.rawlog");
  command
      ->add_option("-p,--plugin", o->common.plugins,
                   "Load classes of --scans from a library; repeatable")
      ->type_name("LIB.so")
      ->allow_extra_args(false);
  command->add_option("--align", o->align, "How to lay the map over the truth (default as the run)")
      ->check(CLI::IsMember(eval::alignNames()));
  command
      ->add_option("--lever-arm", o->leverArm,
                   "The robot's point that the truth is of, as an antenna, in its frame [m] "
                   "(default as the run, else 0,0)")
      ->delimiter(',')
      ->expected(2)
      ->type_name("X,Y");
  command->add_flag("--json", o->json, "Print JSON");
  command->add_option("-o,--output", o->output, "Write JSON to a file")->type_name("FILE");
  command
      ->add_option("--landmark-cutoff", o->options.landmarkCutoff,
                   "Farther from any true one a landmark is false [m]")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command
      ->add_option("--gospa-cutoff", o->options.gospaCutoff,
                   "GOSPA's and OSPA's c [m], of landmarks and targets")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->callback([o, &status] { status = evaluate(*o); });
}
}  // namespace slamot::apps
