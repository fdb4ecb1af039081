#pragma once

#include <slamot/scans/Settings.h>

#include "LoopVotes.h"
#include "keyframes.h"

namespace slamot::scans
{
/// Looks for places where the robot was before.
class LoopCloser
{
 public:
  LoopCloser(const Settings& settings);

  /// Loops from old keyframes to the newest one that are to be believed, and such found before that
  /// only now are.
  [[nodiscard]] std::vector<Relation> search(const PoseGraph& graph, const Keyframes& keyframes);

 private:
  struct Place
  {
    std::size_t node = 0;   ///< the keyframe nearest to the newest one
    double distance = 0;    ///< [m]
    Gaussian<Pose2D> pose;  ///< of the newest one, from there
  };
  [[nodiscard]] std::vector<Place> places(const PoseGraph& graph, const Keyframes& keyframes) const;
  [[nodiscard]] bool isSure(const Place& place) const;

  LoopSettings settings_;
  double recent_, maxRange_, thinning_;
  ScanMatcher matcher_;
  LoopVotes votes_;
};
}  // namespace slamot::scans
