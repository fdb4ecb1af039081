#include "poseErrors.h"

namespace slamot::eval
{
namespace
{
/// What is tracked at each row, in the truth's axes.
std::vector<std::vector<Point2D>> trackedByRow(const Record& record, const Pose2D& truthFromMap)
{
  std::vector<std::vector<Point2D>> out(record.rows.size());
  for (const TargetTrack& track : record.targets)
    for (const TargetRow& t : track.rows)
      out[t.row].push_back(math::transform(truthFromMap, Point2D(t.pose.mean.x, t.pose.mean.y)));
  return out;
}

std::vector<Point2D> presentAt(const Truth& truth, double time, double maxGap)
{
  std::vector<Point2D> out;
  for (const auto& [id, trajectory] : truth.targets)
    if (const auto at = trajectory.at(time, maxGap)) out.emplace_back(at->pose.x, at->pose.y);
  return out;
}
}  // namespace

std::optional<TargetSetErrors> evaluateTargetSet(const Record& record, const Truth& truth,
                                                 const EvaluationOptions& options,
                                                 const Pose2D& truthFromMap)
{
  if (truth.targets.empty()) return std::nullopt;
  const auto tracked = trackedByRow(record, truthFromMap);
  TargetSetErrors sum;
  for (std::size_t i = 0; i < record.rows.size(); ++i)
  {
    if (!record.rows[i].scan) continue;
    const Gospa g = gospa(tracked[i], presentAt(truth, record.rows[i].time, options.maxTruthGap),
                          options.gospaCutoff);
    ++sum.scans;
    sum.estimated += static_cast<double>(g.estimated);
    sum.truly += static_cast<double>(g.truly);
    sum.gospa += g.total;
    sum.localisation += g.localisation;
    sum.missed += g.missed;
    sum.falseOnes += g.falseOnes;
    sum.ospa += g.ospa;
  }
  if (sum.scans == 0) return std::nullopt;
  for (double* v : {&sum.estimated, &sum.truly, &sum.gospa, &sum.localisation, &sum.missed,
                    &sum.falseOnes, &sum.ospa})
    *v /= sum.scans;
  return sum;
}
}  // namespace slamot::eval
