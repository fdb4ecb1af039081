#pragma once

#include <slamot/scans/PoseGraph.h>

namespace slamot::scans
{
/// Loops that may be wrong wait here until others say the same: places look alike, but by chance
/// they seldom do so again and again as the robot moves on.  Olson, "Recognizing places using
/// spectrally clustered local matches", 2009, with groups instead of eigenvectors.
class LoopVotes
{
 public:
  /// \param needed scans whose loops must agree, the new one's counted in.
  explicit LoopVotes(std::size_t needed) : needed_(needed) {}

  /// \param path [m] driven until now.
  /// \returns the loops that are believed now: none, or the new one with those that agree with it.
  std::vector<Relation> add(const PoseGraph& graph, const Relation& loop, double path);
  /// Drops those found before `path` [m].
  void forgetBefore(double path);

 private:
  struct Waiting
  {
    Relation loop;
    double path;
  };
  std::size_t needed_;
  std::vector<Waiting> waiting_;
};
}  // namespace slamot::scans
