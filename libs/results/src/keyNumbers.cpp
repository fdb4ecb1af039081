#include <slamot/results/keyNumbers.h>

#include <slamot/math/statistics.h>
#include <slamot/results/TextFile.h>

#include <algorithm>

namespace slamot::results
{
namespace
{
std::string fixed(double value, int decimals)
{
  std::string text;
  appendFixed(text, value, decimals);
  return text;
}

std::string orDash(const std::optional<double>& value, int decimals, double unit = 1)
{
  return value ? fixed(unit * *value, decimals) : "\u2013";
}

void addTargetRows(Table& table, const std::string& name, const eval::TargetEvaluation& t)
{
  const auto add = [&](const char* when, const eval::ErrorSummary& e)
  {
    if (e.count > 0) table.rows.push_back(errorRow(name + when, e));
  };
  add("", t.all);
  add(", at scans", t.atScans);
  add(", at sightings", t.atSightings);
  add(", relative to robot, at sightings", t.relativeAtSightings);
}

void addTargetFact(Table& table, const eval::Record& record, const TargetGroup& group)
{
  if (!group.evaluation && !group.tracks.empty())
    return table.rows.push_back({"targets " + group.name, trackNames(record, group)});
  if (!group.evaluation || !group.evaluation->trackedFraction) return;
  std::string text = fixed(100 * *group.evaluation->trackedFraction, 1) + "% of the time";
  // Where the sensor gave identities, the one track has the name of the group.
  const auto& tracks = group.tracks;
  if (!tracks.empty() && !record.targets[tracks.front()].identified)
    text += ", " + trackNames(record, group);
  table.rows.push_back({group.name + " tracked", text});
}

void addMapFacts(Table& table, const eval::LandmarkEvaluation& map)
{
  if (!map.mapped) return;
  std::string count = std::to_string(*map.mapped);
  if (map.trueOnes) count += ", of these " + std::to_string(*map.mapped - *map.trueOnes) + " false";
  table.rows.push_back({"landmarks mapped", count});
  if (map.rmse) table.rows.push_back({"landmarks, RMSE", fixed(*map.rmse, 3) + " m"});
  if (map.gospa)
    table.rows.push_back({"landmarks, GOSPA; OSPA",
                          fixed(map.gospa->total, 3) + " m; " + fixed(map.gospa->ospa, 3) + " m"});
}

void addAssociationFacts(Table& table, const eval::AssociationCounts& a)
{
  if (a.correct && a.wrong)
    table.rows.push_back({"landmark sightings paired", std::to_string(*a.correct) + " correctly, " +
                                                           std::to_string(*a.wrong) + " wrongly"});
  table.rows.push_back(
      {"landmark sightings not paired",
       std::to_string(a.created) + " new, " + std::to_string(a.rejected) + " rejected"});
}

void addRelationFacts(Table& table, const std::string& name,
                      const std::optional<eval::RelationErrors>& r)
{
  if (!r || !r->translationMean) return;
  table.rows.push_back({name, fixed(*r->translationMean, 3) + " m, " +
                                  fixed(math::radToDeg(*r->rotationMean), 2) + " deg over " +
                                  std::to_string(r->count)});
}

void addScanMapFacts(Table& table, const std::optional<eval::ScanMapQuality>& s)
{
  if (!s || !s->entropy) return;
  table.rows.push_back({"scan map, mean entropy (less is sharper)", fixed(*s->entropy, 3)});
  if (s->pathEntropy)
    table.rows.push_back(
        {"the same of the path as believed at the end", fixed(*s->pathEntropy, 3)});
  if (s->odometryEntropy)
    table.rows.push_back({"the same of odometry alone", fixed(*s->odometryEntropy, 3)});
}

void addParticleFacts(Table& table, const eval::Record& record)
{
  if (record.particles == 0) return;
  std::vector<double> ess;
  int resamplings = 0;
  for (const auto& step : record.steps)
  {
    if (step.ess) ess.push_back(*step.ess);
    resamplings += step.resampled ? 1 : 0;
  }
  table.rows.push_back({"particles", std::to_string(record.particles) + ", resampled " +
                                         std::to_string(resamplings) + " times"});
  if (ess.empty()) return;
  table.rows.push_back(
      {"effective sample size", fixed(math::quantile(ess, 0.5), 1) + " in the median, at least " +
                                    fixed(*std::min_element(ess.begin(), ess.end()), 1)});
}
}  // namespace

std::vector<std::string> errorHeader()
{
  return {"",           "steps",    "position, mean [m]",
          "median [m]", "RMSE [m]", "heading RMSE [deg]",
          "NEES (3)",   "NEES (2)", "in 95% ellipse [%]"};
}

std::vector<std::string> errorRow(const std::string& name, const eval::ErrorSummary& e)
{
  return {name,
          std::to_string(e.count),
          orDash(e.positionMean, 4),
          orDash(e.positionMedian, 4),
          orDash(e.positionRmse, 4),
          orDash(e.headingRmse, 2, math::radToDeg(1)),
          orDash(e.neesMean, 2),
          orDash(e.neesPositionMean, 2),
          orDash(e.coverage95, 1, 100)};
}

Table errorTable(const RunView& run)
{
  Table table;
  table.header = errorHeader();
  const auto& e = run.evaluation;
  if (e.robot.all.count > 0) table.rows.push_back(errorRow("robot", e.robot.all));
  if (e.robot.atScans.count > 0) table.rows.push_back(errorRow("robot, at scans", e.robot.atScans));
  for (const TargetGroup& group : targetGroups(run.record, e))
    if (group.evaluation) addTargetRows(table, group.name, *group.evaluation);
  return table;
}

Table factTable(const RunView& run)
{
  Table table;
  for (const TargetGroup& group : targetGroups(run.record, run.evaluation))
    addTargetFact(table, run.record, group);
  addMapFacts(table, run.evaluation.landmarks);
  if (run.evaluation.association) addAssociationFacts(table, *run.evaluation.association);
  addRelationFacts(table, "relations, mean errors", run.evaluation.relations);
  addRelationFacts(table, "the same of the path as believed at the end",
                   run.evaluation.pathRelations);
  addScanMapFacts(table, run.evaluation.scanMap);
  addParticleFacts(table, run.record);
  const auto& rows = run.record.rows;
  table.rows.push_back(
      {"steps", std::to_string(run.record.steps.size()) + " over " +
                    fixed(rows.empty() ? 0 : rows.back().time - rows.front().time, 1) + " s"});
  table.rows.push_back({"observations", std::to_string(run.record.observations)});
  return table;
}
}  // namespace slamot::results
