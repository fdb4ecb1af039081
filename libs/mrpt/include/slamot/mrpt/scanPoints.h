#pragma once

#include <slamot/core/Step.h>

namespace slamot::mrpt
{
/// Appends the points that a scan saw, in the frame of the robot's pose.
void appendPoints(std::vector<Point2D>& points, const core::LaserScan& scan, const Pose2D& robot);
}  // namespace slamot::mrpt
