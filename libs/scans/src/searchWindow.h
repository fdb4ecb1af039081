#pragma once

#include <slamot/scans/LocalMap.h>

#include <optional>

namespace slamot::scans
{
/// Where a scan may have been taken from: around a pose, as far as this.
struct SearchWindow
{
  Pose2D centre;
  double radius = 0;                       ///< [m]
  double turn = 0;                         ///< [rad], to either side
  double positionStd = 0, headingStd = 0;  ///< of the expectation: what costs to move away from it
};

struct SearchResult
{
  Pose2D pose;
  double score = 0;  ///< mean likelihood of the points, 0 to 1
};

/// The pose in the window, to a cell and the turn that moves a far point by one, at which points
/// [m, robot's frame] lie best on the map, what is expected counted in.  It is the best one of all:
/// blocks of poses are opened in the order of what they can reach at most.  Olson, "Real-time
/// correlative scan matching", 2009; Hess et al., "Real-time loop closure in 2D LIDAR SLAM", 2016.
/// \returns none if no pose scores `least`.
[[nodiscard]] std::optional<SearchResult> searchWindow(const LocalMap& map,
                                                       const std::vector<Point2D>& points,
                                                       const SearchWindow& window, double least);
}  // namespace slamot::scans
