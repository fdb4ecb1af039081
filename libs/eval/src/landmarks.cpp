#include <cmath>
#include <set>

#include "poseErrors.h"

namespace slamot::eval
{
namespace
{
struct TrueLandmarks
{
  std::vector<int> ids;
  std::vector<Point2D> positions;
};

LandmarkMatch match(const core::LandmarkEstimate& landmark, std::size_t index, int truthId,
                    const Point2D& truth, const Pose2D& truthFromMap)
{
  const Point2D d = math::transform(truthFromMap, landmark.position.mean) - truth;
  const Matrix2 R = math::poseRotation(truthFromMap.phi).topLeftCorner<2, 2>();
  return {index, truthId, std::hypot(d.x, d.y),
          nees(Vector2(d.x, d.y), R * landmark.position.cov * R.transpose())};
}

std::vector<LandmarkMatch> matchById(const Record& record, const Truth& truth,
                                     const Pose2D& truthFromMap)
{
  std::vector<LandmarkMatch> out;
  for (std::size_t i = 0; i < record.landmarks.size(); ++i)
    if (const auto it = truth.landmarks.find(record.landmarks[i].id); it != truth.landmarks.end())
      out.push_back(match(record.landmarks[i], i, it->first, it->second, truthFromMap));
  return out;
}

std::optional<int> countSeen(const Truth& truth)
{
  if (truth.associations.empty()) return std::nullopt;
  std::set<int> seen;
  for (const TrueAssociation& a : truth.associations)
    if (truth.landmarks.count(a.id)) seen.insert(a.id);
  return static_cast<int>(seen.size());
}
}  // namespace

LandmarkEvaluation evaluateLandmarks(const Record& record, const Truth& truth,
                                     const EvaluationOptions& options, const Pose2D& truthFromMap)
{
  LandmarkEvaluation out;
  if (!record.hasMap) return out;
  out.mapped = static_cast<int>(record.landmarks.size());
  if (truth.landmarks.empty()) return out;
  out.seen = countSeen(truth);

  TrueLandmarks truths;
  for (const auto& [id, p] : truth.landmarks)
    truths.ids.push_back(id), truths.positions.push_back(p);
  std::vector<Point2D> estimates;
  for (const auto& m : record.landmarks)
    estimates.push_back(math::transform(truthFromMap, m.position.mean));
  out.gospa = gospa(estimates, truths.positions, options.gospaCutoff);

  if (record.landmarksIdentified())
    out.matches = matchById(record, truth, truthFromMap);
  else
    for (const auto& [i, j] : gospa(estimates, truths.positions, options.landmarkCutoff).pairs)
      out.matches.push_back(
          match(record.landmarks[i], i, truths.ids[j], truths.positions[j], truthFromMap));

  out.trueOnes = static_cast<int>(out.matches.size());
  double squared = 0, neesSum = 0;
  int neesCount = 0;
  for (const LandmarkMatch& m : out.matches)
  {
    squared += m.error * m.error;
    if (m.nees) neesSum += *m.nees, ++neesCount;
  }
  if (!out.matches.empty()) out.rmse = std::sqrt(squared / static_cast<double>(out.matches.size()));
  if (neesCount > 0) out.neesMean = neesSum / neesCount;
  return out;
}
}  // namespace slamot::eval
