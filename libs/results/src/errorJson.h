#pragma once

#include <slamot/eval/Evaluation.h>

#include <nlohmann/json.hpp>

/// Parts of an evaluation as JSON; null for what has no truth or does not apply.
namespace slamot::results
{
using Json = nlohmann::ordered_json;

template <class T>
Json orNull(const std::optional<T>& value)
{
  return value ? Json(*value) : Json(nullptr);
}

[[nodiscard]] Json poseJson(const Pose2D& pose);
[[nodiscard]] Json errorsJson(const eval::ErrorSummary& e);
[[nodiscard]] Json detailedErrors(const eval::ErrorSummary& e);
[[nodiscard]] Json landmarksJson(const eval::LandmarkEvaluation& l);
[[nodiscard]] Json targetSetJson(const std::optional<eval::TargetSetErrors>& t);
[[nodiscard]] Json associationJson(const std::optional<eval::AssociationCounts>& a);
[[nodiscard]] Json relationsJson(const std::optional<eval::RelationErrors>& r,
                                 const std::optional<eval::RelationErrors>& ofPath);
[[nodiscard]] Json scanMapJson(const std::optional<eval::ScanMapQuality>& s);
[[nodiscard]] Json rigidJson(const std::optional<eval::RigidEvaluation>& r);
}  // namespace slamot::results
