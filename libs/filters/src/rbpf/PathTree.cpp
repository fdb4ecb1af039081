#include "PathTree.h"

#include <algorithm>

namespace slamot::filters::rbpf
{
namespace
{
constexpr double kSameInstant = 2e-9;  // [s]
}

void PathTree::step(double time, const Pose2D& since, bool isNew)
{
  if (isNew)
    steps_.push_back({time, draws_, since});
  else if (!steps_.empty() && steps_.back().time >= time - kSameInstant)
    steps_.back() = {steps_.back().time, draws_, since};
}

std::vector<core::PathPose> PathTree::path(Node end) const
{
  std::vector<Pose2D> drawn;
  for (Node n = end; n != kNone; n = nodes_[n].before) drawn.push_back(nodes_[n].pose);
  std::reverse(drawn.begin(), drawn.end());
  std::vector<core::PathPose> out;
  for (const Step& s : steps_)
    out.push_back({s.time, math::compose(drawn.at(s.draws - 1), s.since)});
  return out;
}

bool PathTree::descends(Node node, Node ancestor) const
{
  // Numbers rise along a path.
  while (node != kNone && ancestor != kNone && node > ancestor) node = nodes_[node].before;
  return node == ancestor;
}

void PathTree::sweep(const std::vector<Node*>& ends)
{
  std::vector<Node> to(nodes_.size(), kNone);
  for (const Node* end : ends)
    if (*end != kNone) to[*end] = 0;
  for (std::size_t i = nodes_.size(); i-- > 0;)
    if (to[i] != kNone && nodes_[i].before != kNone) to[nodes_[i].before] = 0;
  kept_ = 0;
  for (std::size_t i = 0; i < nodes_.size(); ++i)
  {
    if (to[i] == kNone) continue;
    Drawn node = nodes_[i];
    if (node.before != kNone) node.before = to[node.before];
    to[i] = static_cast<Node>(kept_);
    nodes_[kept_++] = node;
  }
  nodes_.resize(kept_, Drawn{});
  for (Node* end : ends)
    if (*end != kNone) *end = to[*end];
}
}  // namespace slamot::filters::rbpf
