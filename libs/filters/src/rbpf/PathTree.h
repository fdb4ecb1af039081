#pragma once

#include <slamot/core/Estimate.h>

#include <cstdint>
#include <vector>

namespace slamot::filters::rbpf
{
/// The paths of all particles, as a tree: each time the particles' poses are drawn, every one of
/// them adds a pose to that it had before, which copies of it share.  Between two draws all move
/// alike, so that a step is one entry for all.  What no particle descends from is swept now and
/// then: of old draws few poses are left, in time one.
class PathTree
{
 public:
  using Node = std::uint32_t;
  static constexpr Node kNone = 0xffffffff;

  /// A particle's new pose in the draw that is being taken in, in map axes.
  [[nodiscard]] Node add(Node before, const Pose2D& pose)
  {
    nodes_.push_back({pose, before});
    return static_cast<Node>(nodes_.size() - 1);
  }
  void endDraw() { ++draws_; }

  /// A step's pose: `since` the last draw, in the drawn pose's frame.
  /// \param isNew else it takes the place of the last one, if that is of the same time [s].
  void step(double time, const Pose2D& since, bool isNew);

  /// The path that ends at a node of the last draw.
  [[nodiscard]] std::vector<core::PathPose> path(Node end) const;
  /// Whether a node of the last draw is `ancestor` or comes of it.
  [[nodiscard]] bool descends(Node node, Node ancestor) const;

  [[nodiscard]] bool isDue(std::size_t particles) const
  {
    return nodes_.size() > 2 * kept_ + 16 * particles;
  }
  /// Sweeps what none of these is or comes of, and gives them their new numbers.
  void sweep(const std::vector<Node*>& ends);

  [[nodiscard]] std::size_t size() const { return nodes_.size(); }

 private:
  struct Drawn
  {
    Pose2D pose;
    Node before;  // always in front of it
  };
  struct Step
  {
    double time;
    std::size_t draws;  // so far
    Pose2D since;
  };
  std::vector<Drawn> nodes_;
  std::vector<Step> steps_;
  std::size_t draws_ = 0, kept_ = 0;
};
}  // namespace slamot::filters::rbpf
