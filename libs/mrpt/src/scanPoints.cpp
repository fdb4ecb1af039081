#include <slamot/mrpt/scanPoints.h>

#include <cmath>

namespace slamot::mrpt
{
void appendPoints(std::vector<Point2D>& points, const core::LaserScan& scan, const Pose2D& robot)
{
  const Pose2D sensor = math::compose(robot, scan.pose_robot_sensor);
  for (std::size_t i = 0; i < scan.ranges.size(); ++i)
  {
    const double range = scan.ranges[i];
    if (!(range > 0) || range >= scan.rangeMax) continue;
    const double angle = scan.angleMin + static_cast<double>(i) * scan.angleStep;
    points.push_back(math::transform(sensor, {range * std::cos(angle), range * std::sin(angle)}));
  }
}
}  // namespace slamot::mrpt
