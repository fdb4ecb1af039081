#include <mrpt/system/os.h>
#include <slamot/core/Error.h>
#include <slamot/core/version.h>
#include <slamot/eval/Alignment.h>
#include <slamot/math/statistics.h>
#include <slamot/results/Summary.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "errorJson.h"

namespace slamot::results
{
namespace
{
Json particlesJson(const eval::Record& record)
{
  Json out = {
      {"count", nullptr}, {"resamplings", nullptr}, {"ess_min", nullptr}, {"ess_median", nullptr}};
  if (record.particles == 0) return out;
  std::vector<double> ess;
  int resamplings = 0;
  for (const eval::StepRow& s : record.steps)
  {
    if (s.ess) ess.push_back(*s.ess);
    resamplings += s.resampled ? 1 : 0;
  }
  out["count"] = record.particles;
  out["resamplings"] = resamplings;
  if (ess.empty()) return out;
  out["ess_min"] = *std::min_element(ess.begin(), ess.end());
  out["ess_median"] = math::quantile(ess, 0.5);
  return out;
}

Json detailedTarget(const eval::TargetEvaluation& t)
{
  Json out = {{"id", t.id},
              {"truth_id", orNull(t.truthId)},
              {"tracked_fraction", orNull(t.trackedFraction)},
              {"tracked_since_moved", orNull(t.trackedSinceMoved)},
              {"speed_rmse_mps", orNull(t.speedRmse)},
              {"all", detailedErrors(t.all)},
              {"at_scans", detailedErrors(t.atScans)},
              {"at_sightings", detailedErrors(t.atSightings)},
              {"relative_at_sightings", detailedErrors(t.relativeAtSightings)},
              {"by_time_since_sighting", Json::array()}};
  for (const eval::SinceSeen& bin : t.sinceSeen)
  {
    Json b = {{"from_s", bin.from}, {"to_s", bin.to < 1e8 ? Json(bin.to) : Json(nullptr)}};
    b.update(detailedErrors(bin.errors));
    out["by_time_since_sighting"].push_back(std::move(b));
  }
  return out;
}

std::string dump(const Json& json)
{
  // A dataset's name may hold anything.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}
}  // namespace

// MRPT tells version and date; the date says nothing about a result.
std::string mrptVersion()
{
  const std::string text = ::mrpt::system::MRPT_getVersion();
  const auto first = text.find_first_of("0123456789");
  if (first == std::string::npos) return text;
  return text.substr(first, text.find_first_not_of("0123456789.", first) - first);
}

std::string summaryJson(const RunInfo& info, const eval::Record& record,
                        const eval::Evaluation& evaluation, const Timing& timing)
{
  Json targets = Json::array();
  for (const eval::TargetEvaluation& t : evaluation.targets)
  {
    Json target = {{"id", t.id}};
    target.update(errorsJson(t.all));
    target["tracked_fraction"] = orNull(t.trackedFraction);
    targets.push_back(std::move(target));
  }
  return dump({{"slamot_version", kVersion},
               {"mrpt_version", mrptVersion()},
               {"method", info.method},
               {"dataset", info.dataset},
               {"seed", info.seed},
               {"complete", record.complete},
               {"steps", record.steps.size()},
               {"observations", record.observations},
               {"timing",
                {{"wall_s", timing.wallS},
                 {"cpu_s", timing.cpuS},
                 {"step_median_us", timing.stepMedianUs},
                 {"step_p99_us", timing.stepP99Us},
                 {"peak_rss_mb", timing.peakRssMb}}},
               {"robot", errorsJson(evaluation.robot.all)},
               {"targets", targets},
               {"landmarks", landmarksJson(evaluation.landmarks)},
               {"association", associationJson(evaluation.association)},
               {"particles", particlesJson(record)},
               {"target_set", targetSetJson(evaluation.targetSet)},
               {"rigid", rigidJson(evaluation.rigid)},
               {"relations", relationsJson(evaluation.relations, evaluation.pathRelations)},
               {"scan_map", scanMapJson(evaluation.scanMap)}});
}

std::string evaluationJson(const eval::Record& record, const eval::Evaluation& evaluation)
{
  Json out = {{"align", eval::nameOf(evaluation.align)},
              {"truth_from_map", poseJson(evaluation.truthFromMap)},
              {"robot",
               {{"all", detailedErrors(evaluation.robot.all)},
                {"at_scans", detailedErrors(evaluation.robot.atScans)}}},
              {"targets", Json::array()},
              {"true_targets", Json::array()},
              {"landmarks", landmarksJson(evaluation.landmarks)},
              {"association", associationJson(evaluation.association)},
              {"particles", particlesJson(record)},
              {"target_set", targetSetJson(evaluation.targetSet)},
              {"rigid", rigidJson(evaluation.rigid)},
              {"relations", relationsJson(evaluation.relations, evaluation.pathRelations)},
              {"scan_map", scanMapJson(evaluation.scanMap)}};
  for (const auto& target : evaluation.targets) out["targets"].push_back(detailedTarget(target));
  for (const auto& target : evaluation.trueTargets)
    out["true_targets"].push_back(detailedTarget(target));
  return dump(out);
}

std::optional<SavedSummary> loadSummary(const std::string& folder)
{
  const std::string path = (std::filesystem::path(folder) / "summary.json").string();
  std::ifstream file(path);
  if (!file) return std::nullopt;
  try
  {
    const Json json = Json::parse(file);
    SavedSummary out;
    out.method = json.at("method").get<std::string>();
    out.dataset = json.at("dataset").get<std::string>();
    out.hasMap = !json.at("landmarks").at("mapped").is_null();
    out.complete = json.at("complete").get<bool>();
    out.observations = json.at("observations").get<std::size_t>();
    const Json& particles = json.at("particles").at("count");
    out.particles = particles.is_null() ? 0 : particles.get<int>();
    return out;
  }
  catch (const Json::exception&)
  {
    throw core::Error(core::ExitStatus::kNonsense, path, "is no summary that slamot run wrote",
                      "give a result folder");
  }
}
}  // namespace slamot::results
