#include "errorJson.h"

namespace slamot::results
{
namespace
{
Json gospaParts(double localisation, double missed, double falseOnes)
{
  return {{"localisation", localisation}, {"missed", missed}, {"false", falseOnes}};
}
}  // namespace

Json poseJson(const Pose2D& pose)
{
  return {{"x_m", pose.x}, {"y_m", pose.y}, {"theta_rad", pose.phi}};
}

Json errorsJson(const eval::ErrorSummary& e)
{
  return {{"position_mean_error_m", orNull(e.positionMean)},
          {"position_median_error_m", orNull(e.positionMedian)},
          {"position_rmse_m", orNull(e.positionRmse)},
          {"heading_rmse_rad", orNull(e.headingRmse)},
          {"nees_mean", orNull(e.neesMean)}};
}

Json detailedErrors(const eval::ErrorSummary& e)
{
  Json out = {{"steps", e.count}};
  out.update(errorsJson(e));
  out["nees_position_mean"] = orNull(e.neesPositionMean);
  out["coverage_95"] = orNull(e.coverage95);
  out["nees_skipped"] = e.neesSkipped;
  return out;
}

Json landmarksJson(const eval::LandmarkEvaluation& l)
{
  const auto& g = l.gospa;
  return {
      {"mapped", orNull(l.mapped)},
      {"true", orNull(l.trueOnes)},
      {"rmse_m", orNull(l.rmse)},
      {"gospa_m", g ? Json(g->total) : Json(nullptr)},
      {"gospa_parts_m2", g ? gospaParts(g->localisation, g->missed, g->falseOnes) : Json(nullptr)},
      {"ospa_m", g ? Json(g->ospa) : Json(nullptr)},
      {"seen", orNull(l.seen)}};
}

Json targetSetJson(const std::optional<eval::TargetSetErrors>& t)
{
  if (!t) return nullptr;
  return {{"scans", t->scans},
          {"estimated_mean", t->estimated},
          {"true_mean", t->truly},
          {"gospa_mean_m", t->gospa},
          {"gospa_parts_mean_m2", gospaParts(t->localisation, t->missed, t->falseOnes)},
          {"ospa_mean_m", t->ospa}};
}

Json associationJson(const std::optional<eval::AssociationCounts>& a)
{
  if (!a)
    return {{"correct", nullptr},
            {"wrong", nullptr},
            {"new", nullptr},
            {"rejected", nullptr},
            {"right_of_paired", nullptr},
            {"right_of_sightings", nullptr},
            {"paired_of_clutter", nullptr}};
  return {{"correct", orNull(a->correct)},
          {"wrong", orNull(a->wrong)},
          {"new", a->created},
          {"rejected", a->rejected},
          {"right_of_paired", orNull(a->rightOfPaired())},
          {"right_of_sightings", orNull(a->rightOfSightings())},
          {"paired_of_clutter", orNull(a->pairedOfClutter())}};
}

Json relationsJson(const std::optional<eval::RelationErrors>& r,
                   const std::optional<eval::RelationErrors>& ofPath)
{
  if (!r) return nullptr;
  const auto errors = [](const eval::RelationErrors& e)
  {
    return Json{{"count", e.count},
                {"translation_mean_error_m", orNull(e.translationMean)},
                {"rotation_mean_error_rad", orNull(e.rotationMean)}};
  };
  Json out = errors(*r);
  out["path"] = ofPath ? errors(*ofPath) : Json(nullptr);
  return out;
}

Json scanMapJson(const std::optional<eval::ScanMapQuality>& s)
{
  if (!s) return nullptr;
  return {{"points", s->points},
          {"mean_map_entropy", orNull(s->entropy)},
          {"odometry_mean_map_entropy", orNull(s->odometryEntropy)},
          {"path_entropy", orNull(s->pathEntropy)}};
}

Json rigidJson(const std::optional<eval::RigidEvaluation>& r)
{
  if (!r) return nullptr;
  return {{"truth_from_map", poseJson(r->truthFromMap)},
          {"robot", errorsJson(r->robot)},
          {"target_set", targetSetJson(r->targetSet)},
          {"truth_from_landmarks", poseJson(r->truthFromLandmarks)},
          {"landmarks", landmarksJson(r->landmarks)}};
}
}  // namespace slamot::results
