#include "LoopVotes.h"

#include <Eigen/LU>
#include <algorithm>
#include <set>

#include "reach.h"

namespace slamot::scans
{
namespace
{
constexpr double kGate = 16.3;                        // 99.9 % at 3 degrees of freedom
constexpr double kVague = 0.7, kVagueHeading = 0.15;  // [m, rad]: what agrees with anything

/// Whether two loops tell the same, by how their ends lie to each other.
/// \param fromEnds, toEnds every node from loop a's ends.
bool agree(const Relation& a, const Relation& b, const std::vector<Gaussian<Pose2D>>& fromEnds,
           const std::vector<Gaussian<Pose2D>>& toEnds)
{
  const Gaussian<Pose2D> there = math::compose(a.pose_from_to, toEnds[b.to]);
  const Gaussian<Pose2D> expected = math::compose(inverse(fromEnds[b.from]), there);
  const Matrix3 cov = expected.cov + b.pose_from_to.cov;
  if (cov(0, 0) + cov(1, 1) > kVague * kVague || cov(2, 2) > kVagueHeading * kVagueHeading)
    return false;
  const Pose2D &e = expected.mean, &m = b.pose_from_to.mean;
  const Vector3 d{m.x - e.x, m.y - e.y, math::wrapToPi(m.phi - e.phi)};
  return d.dot(cov.inverse() * d) < kGate;
}

/// Loops of one scan are one witness.
std::size_t witnesses(const std::vector<Relation>& loops)
{
  std::set<std::size_t> scans;
  for (const Relation& loop : loops) scans.insert(loop.to);
  return scans.size();
}
}  // namespace

std::vector<Relation> LoopVotes::add(const PoseGraph& graph, const Relation& loop, double path)
{
  std::vector<Relation> agreed{loop};
  std::vector<Waiting> others;
  if (!waiting_.empty())
  {
    const auto fromEnds = reachFrom(graph, loop.from), toEnds = reachFrom(graph, loop.to);
    for (const Waiting& w : waiting_)
      if (agree(loop, w.loop, fromEnds, toEnds))
        agreed.push_back(w.loop);
      else
        others.push_back(w);
  }
  if (witnesses(agreed) < needed_)
  {
    waiting_.push_back({loop, path});
    return {};
  }
  waiting_ = std::move(others);
  return agreed;
}

void LoopVotes::forgetBefore(double path)
{
  waiting_.erase(std::remove_if(waiting_.begin(), waiting_.end(),
                                [&](const Waiting& w) { return w.path < path; }),
                 waiting_.end());
}
}  // namespace slamot::scans
