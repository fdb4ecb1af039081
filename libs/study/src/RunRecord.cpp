#include <slamot/study/RunRecord.h>

#include <slamot/core/Error.h>
#include <slamot/results/TextFile.h>
#include <slamot/study/Metrics.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

namespace slamot::study
{
namespace
{
using Json = nlohmann::ordered_json;
using Value = std::optional<double>;

Json toJson(const Value& value)
{
  return value ? Json(*value) : Json(nullptr);
}

Value valueOf(const Json& json)
{
  return json.is_null() ? std::nullopt : Value(json.get<double>());
}

Json toJson(const ErrorCurves& curves)
{
  Json out;
  out["duration_s"] = curves.durationS;
  for (const ErrorCurves::Curve& c : curves.curves)
    for (const Value& v : c.values) out[c.name].push_back(toJson(v));
  return out;
}

ErrorCurves curvesOf(const Json& json)
{
  ErrorCurves out;
  out.durationS = json.at("duration_s").get<double>();
  for (const auto& [name, values] : json.items())
  {
    if (!values.is_array()) continue;
    out.curves.push_back({name, {}});
    for (const Json& value : values) out.curves.back().values.push_back(valueOf(value));
  }
  return out;
}

Json toJson(const Plan& plan, const Run& run, const RunRecord& record)
{
  const Group& group = plan.groups[run.group];
  Json out;
  out["method"] = plan.spec.methods[group.method].name;
  const auto names = plan.cellNames(), values = plan.cellValues(plan.cells[group.cell]);
  for (std::size_t i = 0; i < names.size(); ++i) out["cell"][names[i]] = values[i];
  out["hash"] = record.hash;
  out["seed"] = record.seed;
  out["status"] = record.status;
  out["error"] = record.error;
  out["wall_s"] = record.wallS;
  out["cpu_s"] = record.cpuS;
  for (std::size_t i = 0; i < record.metrics.size(); ++i)
    out["metrics"][metrics()[i].name] = toJson(record.metrics[i]);
  if (record.error.empty() && plan.spec.timeBins > 0) out["curves"] = toJson(record.curves);
  return out;
}

/// \throws nlohmann::json::exception on what is no record.
RunRecord fromJson(const Json& json)
{
  RunRecord out;
  out.hash = json.at("hash").get<std::string>();
  out.seed = json.at("seed").get<std::uint64_t>();
  out.status = json.at("status").get<int>();
  out.error = json.at("error").get<std::string>();
  out.wallS = json.at("wall_s").get<double>();
  out.cpuS = json.at("cpu_s").get<double>();
  if (!out.error.empty()) return out;
  for (const Metric& m : metrics()) out.metrics.push_back(valueOf(json.at("metrics").at(m.name)));
  if (json.contains("curves")) out.curves = curvesOf(json["curves"]);
  return out;
}
}  // namespace

RecordState loadRecord(const std::string& folder, const Plan& plan, const Run& run,
                       RunRecord& record)
{
  std::ifstream file(folder + "/" + plan.recordPath(run), std::ios::binary);
  if (!file) return RecordState::kAbsent;
  try
  {
    const Json json = Json::parse(file);
    // A record of other metrics is of another version, not damaged.
    if (json.at("hash") != plan.groups[run.group].hash || json.at("seed") != run.seed)
      return RecordState::kStale;
    record = fromJson(json);
    const bool isFailed = !record.error.empty(),
               hasStatus = record.status >= 1 && record.status <= 6;
    return isFailed == hasStatus ? RecordState::kGood : RecordState::kDamaged;
  }
  catch (const nlohmann::json::exception&)
  {
    return RecordState::kDamaged;
  }
}

void saveRecord(const std::string& folder, const Plan& plan, const Run& run,
                const RunRecord& record)
{
  const std::filesystem::path path = folder + "/" + plan.recordPath(run);
  std::error_code error;
  std::filesystem::create_directories(path.parent_path(), error);
  if (error)
    throw core::Error(core::ExitStatus::kUnreadable, path.parent_path().string(),
                      "can't be made: " + error.message(), "write elsewhere");
  const std::string text =
      toJson(plan, run, record).dump(1, ' ', false, Json::error_handler_t::replace);
  results::writeWhole(path.string(), text + "\n");
}
}  // namespace slamot::study
