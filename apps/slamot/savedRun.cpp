#include "savedRun.h"

#include <slamot/core/Error.h>
#include <slamot/core/Params.h>
#include <slamot/eval/Alignment.h>
#include <slamot/results/RecordFiles.h>
#include <slamot/results/Report.h>
#include <slamot/results/RunPlan.h>
#include <slamot/results/TruthFiles.h>
#include <slamot/team/savedTeam.h>

#include <filesystem>

#include "laserMaps.h"

namespace slamot::apps
{
namespace
{
namespace fs = std::filesystem;
using core::Error;
using core::ExitStatus;

std::string titleOf(const std::string& folder)
{
  const auto summary = results::loadSummary(folder);
  if (!summary) return fs::path(folder).lexically_normal().filename().string();
  results::RunInfo info;
  info.method = summary->method, info.dataset = summary->dataset;
  return results::titleOf(info) + (summary->complete ? "" : ", incomplete");
}

void requireFolder(const std::string& folder)
{
  if (!fs::is_directory(folder))
    throw Error(
        ExitStatus::kUnreadable, folder,
        fs::exists(folder) ? "is one moment of a run, and no result folder" : "is not there",
        "give the folder that slamot run wrote");
}

/// Without evaluation, scans and particles.
SavedRun readRun(const std::string& folder, const std::string& truth)
{
  SavedRun run;
  run.title = titleOf(folder);
  run.record = results::loadRecord(folder);
  if (run.record.rows.empty())
    throw Error(ExitStatus::kTruncated, folder, "holds no step of a run", "run the filter anew");
  if (auto found = findTruth(folder, truth)) run.truth = std::move(*found);
  if (!truth.empty() && isEmpty(run.truth))
    throw Error(ExitStatus::kUnreadable, truth, "there is no truth",
                "give --truth the path of X.truth or X.rawlog");
  return run;
}

/// What pictures have besides: scans and particles.
void addPictured(const std::string& folder, SavedRun& run)
{
  loadLasers(folder, run.record);
  for (const Point2D& p : mrpt::loadParticles((fs::path(folder) / "scene.3Dscene").string()))
    run.particles.push_back({{p.x, p.y, 0}, 1});
}
}  // namespace

bool isEmpty(const eval::Truth& t)
{
  return t.robot.empty() && t.targets.empty() && t.landmarks.empty() && t.associations.empty() &&
         t.relations.empty();
}

std::optional<eval::Truth> findTruth(const std::string& result, std::string prefix)
{
  if (prefix.empty())
    if (const auto summary = results::loadSummary(result)) prefix = summary->dataset;
  if (prefix.empty()) return std::nullopt;
  if (fs::is_directory(prefix)) return results::loadTruth(prefix);
  if (!fs::is_regular_file(prefix) || fs::path(prefix).extension() != ".tum")
    return results::loadTruth(results::truthFolder(prefix));
  eval::Truth truth;
  truth.robot = results::loadTum(prefix);
  return truth;
}

eval::EvaluationOptions savedOptions(const std::string& folder)
{
  eval::EvaluationOptions out;
  out.align = eval::Align::kFirstPose;
  const fs::path config = fs::path(folder) / "config.ini";
  if (!fs::exists(config)) return out;
  core::Config ini = core::Config::load(config.string());
  out.align =
      *eval::alignNamed(core::Params(ini, "run").choice("align", eval::alignNames(), "first-pose"));
  out.leverArm = results::readLeverArm(ini);
  return out;
}

SavedRun loadSavedRun(const std::string& folder, const std::string& truth)
{
  requireFolder(folder);
  if (const auto names = team::robotsIn(folder); !names.empty())
    throw Error(ExitStatus::kConfig, folder, "is of a team",
                "give the folder of one robot, such as " + (fs::path(folder) / names[0]).string());
  SavedRun run = readRun(folder, truth);
  run.evaluation = eval::evaluate(run.record, run.truth, savedOptions(folder));
  addPictured(folder, run);
  return run;
}

SavedTeam loadSavedTeam(const std::string& folder)
{
  requireFolder(folder);
  SavedTeam team;
  team.title = team::titleIn(folder);
  team.names = team::robotsIn(folder);
  const auto placeOf = [&](std::size_t r) { return (fs::path(folder) / team.names[r]).string(); };
  std::vector<eval::RunWithTruth> together;
  for (std::size_t r = 0; r < team.names.size(); ++r)
  {
    requireFolder(placeOf(r));
    team.runs.push_back(readRun(placeOf(r), ""));
  }
  for (const SavedRun& run : team.runs) together.push_back({&run.record, &run.truth});
  const auto evaluations = eval::evaluateTogether(together, savedOptions(folder));
  for (std::size_t r = 0; r < team.names.size(); ++r)
  {
    team.runs[r].evaluation = evaluations[r];
    addPictured(placeOf(r), team.runs[r]);
  }
  return team;
}
}  // namespace slamot::apps
