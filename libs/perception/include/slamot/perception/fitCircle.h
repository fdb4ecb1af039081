#pragma once

#include <slamot/math/gaussian.h>
#include <slamot/perception/LaserClusters.h>

#include <optional>

namespace slamot::perception
{
/// What is known of a round thing before it is seen [m].
struct Roundness
{
  double radius = 0.1;      ///< [m]
  double radiusStd = 0.02;  ///< [m]
};

/// A circle through returns, which lie on the side that the laser sees.
struct CircleFit
{
  Gaussian<Point2D> center;  ///< in the robot's frame
  double radius = 0;         ///< [m]
  double radiusStd = 0;      ///< [m]
  double misfit = 0;         ///< mean square of the residuals, each in its own deviation
  int points = 0;            ///< that it went through: others were taken for another thing's
};

/// Least squares over centre and radius (Gauss and Newton), with the radius's prior, which a few
/// returns don't tell anew.  Returns more than three deviations off are left out, once.
/// \param laser its place in the robot's frame.  \param angleStep between beams [rad].
/// \returns nothing where no circle comes out: fewer than two returns, or a centre before them.
[[nodiscard]] std::optional<CircleFit> fitCircle(const std::vector<ScanPoint>& points,
                                                 const Point2D& laser, double angleStep,
                                                 double rangeStd, const Roundness& prior);
}  // namespace slamot::perception
