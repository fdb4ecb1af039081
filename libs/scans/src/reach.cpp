#include "reach.h"

#include <limits>
#include <queue>

namespace slamot::scans
{
namespace
{
constexpr double kLever = 5;  // [m] by which a heading's error counts beside a position's

double sizeOf(const Matrix3& cov)
{
  return cov(0, 0) + cov(1, 1) + kLever * kLever * cov(2, 2);
}
}  // namespace

Gaussian<Pose2D> inverse(const Gaussian<Pose2D>& g)
{
  Gaussian<Pose2D> out;
  out.mean = math::between(g.mean, Pose2D(0, 0, 0));
  Matrix3 J = -math::poseRotation(g.mean.phi).transpose();
  J(0, 2) = out.mean.y;
  J(1, 2) = -out.mean.x;
  out.cov = J * g.cov * J.transpose();
  return out;
}

std::vector<Gaussian<Pose2D>> reachFrom(const PoseGraph& graph, std::size_t node)
{
  const std::size_t n = graph.poses().size();
  std::vector<std::vector<std::pair<std::size_t, Matrix3>>> neighbours(n);
  for (const Relation& r : graph.relations())
  {
    if (graph.trust(r) < 0.5) continue;
    const Pose2D is = math::between(graph.pose(r.from), graph.pose(r.to));
    neighbours[r.from].emplace_back(r.to, r.pose_from_to.cov);
    neighbours[r.to].emplace_back(r.from, inverse({is, r.pose_from_to.cov}).cov);
  }
  std::vector<Gaussian<Pose2D>> out(n);
  std::vector<double> best(n, std::numeric_limits<double>::infinity());
  using Entry = std::pair<double, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  best[node] = 0;
  open.emplace(0, node);
  while (!open.empty())
  {
    const auto [size, at] = open.top();
    open.pop();
    if (size > best[at]) continue;
    for (const auto& [to, cov] : neighbours[at])
    {
      const Gaussian<Pose2D> hop{math::between(graph.pose(at), graph.pose(to)), cov};
      const Gaussian<Pose2D> there = math::compose(out[at], hop);
      const double cost = sizeOf(there.cov);
      if (!(cost < best[to])) continue;  // nor where it is no number
      best[to] = cost;
      out[to] = there;
      open.emplace(cost, to);
    }
  }
  return out;
}
}  // namespace slamot::scans
