#include "metricEntries.h"

namespace slamot::study
{
namespace
{
Value falseLandmarks(const Measured& r)
{
  const auto& l = r.evaluation.landmarks;
  if (!l.mapped || !l.trueOnes) return std::nullopt;
  return *l.mapped - *l.trueOnes;
}

/// Features of the map by the true ones that were seen.
Value mappedOverSeen(const Measured& r)
{
  const auto& l = r.evaluation.landmarks;
  if (!l.mapped || !l.seen || *l.seen == 0) return std::nullopt;
  return static_cast<double>(*l.mapped) / *l.seen;
}

/// What an evaluation says of the map; null if nothing.
using MapOf = const eval::LandmarkEvaluation* (*)(const eval::Evaluation&);
constexpr MapOf kMap = [](const eval::Evaluation& e) { return &e.landmarks; };
constexpr MapOf kRigidMap = [](const eval::Evaluation& e)
{ return e.rigid ? &e.rigid->landmarks : nullptr; };

std::function<Value(const Measured&)> mapSet(MapOf map, double eval::Gospa::*which)
{
  return [=](const Measured& r) -> Value
  {
    const auto* l = map(r.evaluation);
    if (!l || !l->gospa) return std::nullopt;
    return (*l->gospa).*which;
  };
}

Value rigidMapRmse(const Measured& r)
{
  return r.evaluation.rigid ? r.evaluation.rigid->landmarks.rmse : std::nullopt;
}

using Share = Value (eval::AssociationCounts::*)() const;
std::function<Value(const Measured&)> share(Share which)
{
  return [=](const Measured& r)
  { return r.evaluation.association ? ((*r.evaluation.association).*which)() : std::nullopt; };
}

Value pairs(const Measured& r, std::optional<int> eval::AssociationCounts::*which)
{
  if (!r.evaluation.association) return std::nullopt;
  return number((*r.evaluation.association).*which);
}
}  // namespace

std::vector<MetricEntry> mapMetrics()
{
  using G = eval::Gospa;
  using A = eval::AssociationCounts;
  return {
      {{"landmarks_mapped", "landmarks mapped", 1},
       [](const Measured& r) { return number(r.evaluation.landmarks.mapped); }},
      {{"landmarks_seen", "true landmarks seen", 1},
       [](const Measured& r) { return number(r.evaluation.landmarks.seen); }},
      {{"landmarks_mapped_over_seen", "landmarks mapped by those seen", 3}, mappedOverSeen},
      {{"landmarks_false", "of them false", 2}, falseLandmarks},
      {{"landmarks_rmse_m", "landmark RMSE [m]", 4},
       [](const Measured& r) { return r.evaluation.landmarks.rmse; }},
      {{"landmarks_gospa_m", "landmark GOSPA [m]", 3}, mapSet(kMap, &G::total)},
      {{"pairs_correct", "sightings paired rightly", 1},
       [](const Measured& r) { return pairs(r, &eval::AssociationCounts::correct); }},
      {{"pairs_wrong", "sightings paired wrongly", 2},
       [](const Measured& r) { return pairs(r, &eval::AssociationCounts::wrong); }},
      {{"landmarks_localisation_m2", "GOSPA's part localisation [m2]", 2},
       mapSet(kMap, &G::localisation)},
      {{"landmarks_missed_m2", "GOSPA's part missed [m2]", 2}, mapSet(kMap, &G::missed)},
      {{"landmarks_false_m2", "GOSPA's part false [m2]", 2}, mapSet(kMap, &G::falseOnes)},
      {{"landmarks_ospa_m", "landmark OSPA [m]", 3}, mapSet(kMap, &G::ospa)},
      {{"landmarks_rigid_rmse_m", "landmark RMSE, aligned [m]", 4}, rigidMapRmse},
      {{"landmarks_rigid_gospa_m", "landmark GOSPA, aligned [m]", 3}, mapSet(kRigidMap, &G::total)},
      {{"landmarks_rigid_localisation_m2", "aligned GOSPA's part localisation [m2]", 2},
       mapSet(kRigidMap, &G::localisation)},
      {{"landmarks_rigid_missed_m2", "aligned GOSPA's part missed [m2]", 2},
       mapSet(kRigidMap, &G::missed)},
      {{"landmarks_rigid_false_m2", "aligned GOSPA's part false [m2]", 2},
       mapSet(kRigidMap, &G::falseOnes)},
      {{"landmarks_rigid_ospa_m", "landmark OSPA, aligned [m]", 3}, mapSet(kRigidMap, &G::ospa)},
      {{"pairs_right_share", "right of the sightings paired", 4}, share(&A::rightOfPaired)},
      {{"sightings_right_share", "right of the sightings of landmarks", 4},
       share(&A::rightOfSightings)},
      {{"clutter_paired_share", "false alarms paired", 4}, share(&A::pairedOfClutter)},
  };
}
}  // namespace slamot::study
