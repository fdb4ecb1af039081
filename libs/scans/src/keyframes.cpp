#include "keyframes.h"

namespace slamot::scans
{
std::vector<Point2D> pointsOf(const Keyframes& keyframes, const PoseGraph& graph, std::size_t first,
                              std::size_t last, const Pose2D& frame)
{
  std::vector<Point2D> out;
  for (std::size_t i = first; i <= last; ++i)
  {
    const Pose2D pose = math::between(frame, graph.pose(i));
    for (const Point2D& p : keyframes[i].points) out.push_back(math::transform(pose, p));
  }
  return out;
}

std::pair<std::size_t, std::size_t> around(const Keyframes& keyframes, std::size_t node,
                                           double stretch)
{
  constexpr std::size_t kMost = 60;  // a robot that turns on the spot adds no path
  std::size_t first = node, last = node;
  while (first > 0 && node - first < kMost &&
         keyframes[node].path - keyframes[first - 1].path <= stretch)
    --first;
  while (last + 1 < keyframes.size() && last - node < kMost &&
         keyframes[last + 1].path - keyframes[node].path <= stretch)
    ++last;
  return {first, last};
}
}  // namespace slamot::scans
