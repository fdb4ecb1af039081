#include <slamot/core/Error.h>
#include <slamot/core/Params.h>
#include <slamot/eval/Alignment.h>
#include <slamot/results/RecordFiles.h>
#include <slamot/results/Summary.h>
#include <slamot/results/TextFile.h>
#include <slamot/results/TruthFiles.h>

#include <charconv>
#include <cstdio>
#include <filesystem>

#include "Command.h"

namespace slamot::apps
{
namespace
{
namespace fs = std::filesystem;
using core::Error;
using core::ExitStatus;

struct EvaluateCommand
{
  std::string result, truth, align, output;
  bool json = false;
  eval::EvaluationOptions options;
};

bool isEmpty(const eval::Truth& t)
{
  return t.robot.empty() && t.targets.empty() && t.landmarks.empty() && t.associations.empty();
}

// PREFIX may be the folder of truth, the log it goes with, or one trajectory of the robot.
eval::Truth findTruth(const EvaluateCommand& o)
{
  std::string prefix = o.truth;
  if (prefix.empty())
    if (const auto summary = results::loadSummary(o.result)) prefix = summary->dataset;
  if (prefix.empty())
    throw Error(ExitStatus::kConfig, "evaluate " + o.result,
                "which truth it goes with is not known", "give --truth PREFIX");
  eval::Truth truth;
  if (fs::is_regular_file(prefix) && fs::path(prefix).extension() == ".tum")
    truth.robot = results::loadTum(prefix);
  else if (fs::is_directory(prefix))
    truth = results::loadTruth(prefix);
  else
    truth = results::loadTruth(results::truthFolder(prefix));
  if (isEmpty(truth))
    throw Error(ExitStatus::kUnreadable, prefix, "there is no truth",
                "give --truth the path of X.truth or X.rawlog");
  return truth;
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
eval::Align alignOf(const EvaluateCommand& o)
{
  if (!o.align.empty()) return *eval::alignNamed(o.align);
  const fs::path config = fs::path(o.result) / "config.ini";
  if (!fs::exists(config)) return eval::Align::kFirstPose;
  core::Config ini = core::Config::load(config.string());
  return *eval::alignNamed(
      core::Params(ini, "run").choice("align", eval::alignNames(), "first-pose"));
}

int evaluate(EvaluateCommand o)
{
  const bool isFolder = fs::is_directory(o.result);
  if (!isFolder && !fs::exists(o.result))
    throw Error(ExitStatus::kUnreadable, o.result, "is not there",
                "give a result folder or a TUM file");
  const eval::Record record =
      isFolder ? results::loadRecord(o.result) : results::loadTumRecord(o.result);
  eval::Truth truth = findTruth(o);
  if (!isFolder) takeTargetForRobot(o.result, truth);
  o.options.align = alignOf(o);
  const eval::Evaluation evaluation = eval::evaluate(record, truth, o.options);
  const std::string json = results::evaluationJson(record, evaluation);
  if (!o.output.empty()) results::writeWhole(o.output, json);
  if (o.json)
    std::printf("%s", json.c_str());
  else
    std::printf("%s (align %s)\n%s", o.result.c_str(), eval::nameOf(evaluation.align).c_str(),
                results::summaryTable(record, evaluation, true).c_str());
  return static_cast<int>(ExitStatus::kDone);
}
}  // namespace

void addEvaluate(CLI::App& app, int& status)
{
  auto o = std::make_shared<EvaluateCommand>();
  CLI::App* command = app.add_subcommand(
      "evaluate",
      "Errors and consistency of a result folder, or a TUM file, against truth.\n"
      "Example: slamot evaluate slamot-out/rbpf-slamot-experiment1 --align rigid");
  command->add_option("result", o->result, "A result folder or a TUM file")
      ->required()
      ->type_name("RESULT");
  command
      ->add_option("--truth", o->truth,
                   "X.truth or X.rawlog (default: of the log that the result is of)")
      ->type_name("PREFIX");
  command->add_option("--align", o->align, "How to lay the map over the truth (default as the run)")
      ->check(CLI::IsMember(eval::alignNames()));
  command->add_flag("--json", o->json, "Print JSON");
  command->add_option("-o,--output", o->output, "Write JSON to a file")->type_name("FILE");
  command
      ->add_option("--landmark-cutoff", o->options.landmarkCutoff,
                   "Farther from any true one a landmark is false [m]")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--gospa-cutoff", o->options.gospaCutoff, "GOSPA's c [m]")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->callback([o, &status] { status = evaluate(*o); });
}
}  // namespace slamot::apps
