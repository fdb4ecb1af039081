#pragma once

#include <slamot/core/run.h>
#include <slamot/mrpt/Scene.h>

#include <map>
#include <set>

namespace slamot::mrpt
{
/// A run in progress as what can be drawn.
class LiveScene
{
 public:
  /// `title` is drawn above the scene.
  explicit LiveScene(std::string title);

  /// The belief before the first step.
  void begin(const core::Estimate& start) { addEstimate(start); }
  /// A step, and what was believed after it.
  void add(const core::Step& step, const core::Update& update);
  /// All so far.  \param now after the newest step: its map is read.
  [[nodiscard]] SceneData at(const core::Estimate& now,
                             std::vector<core::WeightedPose> particles) const;

 private:
  static constexpr double kCell = 0.1;                // of laser points, one is kept in each [m]
  static constexpr std::size_t kMostPoints = 200000;  // drawn at each step: bounded

  void addEstimate(const core::Estimate& estimate);
  void addLasers(const core::Step& step, const Pose2D& robot);

  SceneData data_;
  std::map<std::pair<bool, int>, std::size_t> targets_;  // by (not identified, id)
  std::set<std::pair<long, long>> cells_;
};
}  // namespace slamot::mrpt
