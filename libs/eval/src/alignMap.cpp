#include <slamot/eval/Alignment.h>

#include "poseErrors.h"

namespace slamot::eval
{
namespace
{
constexpr int kMostTurns = 50;

class MapAlignment
{
 public:
  MapAlignment(const Record& record, const Truth& truth, double cutoff) : cutoff_(cutoff)
  {
    for (const auto& m : record.landmarks) estimates_.push_back(m.position.mean);
    for (const auto& [id, p] : truth.landmarks) truths_.push_back(p);
  }

  /// Goes on from an alignment as long as GOSPA falls; keeps the best of all calls.
  void improve(const Pose2D& start)
  {
    Pose2D pose = start;
    for (int i = 0; i < kMostTurns; ++i)
    {
      const Gospa g = gospa(moved(pose), truths_, cutoff_);
      if (best_ && g.total >= best_->total) return;
      best_ = {g.total, pose};
      if (g.pairs.empty()) return;
      std::vector<Point2D> from, to;
      for (const auto& [e, t] : g.pairs) from.push_back(estimates_[e]), to.push_back(truths_[t]);
      pose = rigidAlignment(from, to);
    }
  }

  [[nodiscard]] Pose2D best() const { return best_->pose; }

 private:
  struct Best
  {
    double total;
    Pose2D pose;
  };

  [[nodiscard]] std::vector<Point2D> moved(const Pose2D& by) const
  {
    std::vector<Point2D> out;
    for (const Point2D& p : estimates_) out.push_back(math::transform(by, p));
    return out;
  }

  double cutoff_;
  std::vector<Point2D> estimates_, truths_;
  std::optional<Best> best_;
};

/// Least squares over what each mapped landmark truly is; none if the truth doesn't tell.
std::optional<Pose2D> byIdentity(const Record& record, const Truth& truth)
{
  const auto founders = foundersByLandmark(record, truth);
  std::vector<Point2D> from, to;
  for (const auto& m : record.landmarks)
  {
    const auto founder = founders.find(m.id);
    if (founder == founders.end() || !truth.landmarks.count(founder->second)) continue;
    from.push_back(m.position.mean);
    to.push_back(truth.landmarks.at(founder->second));
  }
  if (from.empty()) return std::nullopt;
  return rigidAlignment(from, to);
}
}  // namespace

Pose2D alignMap(const Record& record, const Truth& truth, double gospaCutoff,
                const std::vector<Pose2D>& starts)
{
  if (record.landmarks.empty() || truth.landmarks.empty()) return starts.front();
  MapAlignment alignment(record, truth, gospaCutoff);
  for (const Pose2D& start : starts) alignment.improve(start);
  if (const auto pose = byIdentity(record, truth)) alignment.improve(*pose);
  return alignment.best();
}
}  // namespace slamot::eval
