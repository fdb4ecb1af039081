#pragma once

#include <slamot/math/gaussian.h>
#include <slamot/scans/LocalMap.h>

namespace slamot::scans
{
struct Alignment
{
  Pose2D pose;
  Matrix3 information = Matrix3::Zero();  ///< of the scan alone, in the map's axes
  double explained = 0;                   ///< share of the points that lie on surfaces, 0 to 1
};

/// Moves a scan from `start` to where its points lie on the map's walls: Gauss-Newton on distances
/// from point to line, with Geman and McClure's kernel, so that what moved since or is new counts
/// little.  \param expected what is known besides, taken in like a measurement.
/// \param inflation of what one point's variance tells: neighbours err alike.
[[nodiscard]] Alignment align(const LocalMap& map, const std::vector<Point2D>& points,
                              const Pose2D& start, const Gaussian<Pose2D>& expected,
                              double rangeStd, double inflation);
}  // namespace slamot::scans
