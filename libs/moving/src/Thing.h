#pragma once

#include <slamot/core/Step.h>
#include <slamot/moving/FreeSpace.h>
#include <slamot/perception/LaserClusters.h>

#include "boxBeams.h"

namespace slamot::moving
{
/// A scan, and from where it was taken, in the tracks' axes.
struct Look
{
  double time;  ///< [s]
  Pose2D robot;
  Pose2D laser;
  double beamStep;  ///< between beams, positive [rad]
  const core::LaserScan* scan;

  Look(double time, const Pose2D& robot, const core::LaserScan& scan);
  [[nodiscard]] Point2D at(const perception::ScanPoint& p) const;
  /// Its direction from the laser [rad].
  [[nodiscard]] double towards(const Point2D& p) const;
  [[nodiscard]] double rangeOf(const Point2D& p) const;
  /// Whether most beams near its middle go on behind it by over `depth` [m]: it is not there.
  [[nodiscard]] bool goesThrough(const Point2D& p, double depth) const;
};

/// Some neighbouring returns that may be of one thing, in the tracks' axes.
struct Thing
{
  std::vector<Point2D> points;     ///< [m]
  std::vector<std::size_t> beams;  ///< of the points
  Point2D centre;                  ///< their mean [m]
  std::optional<End> right, left;  ///< where it ends
  bool isWhole = false;            ///< nothing nearer hides its ends
  double freePart = 0;             ///< of its points, those where nothing was
};

/// The points [from, to) of a cluster.
[[nodiscard]] Thing thingOf(const perception::Cluster& cluster, std::size_t from, std::size_t to,
                            const Look& look, const FreeSpace& space);
/// Adds another part of the same thing.
void join(Thing& all, const Thing& part, const Look& look);
/// The part of some points that lies where nothing stands.
[[nodiscard]] double freePartOf(const std::vector<Point2D>& points, const Look& look,
                                const FreeSpace& space);
}  // namespace slamot::moving
