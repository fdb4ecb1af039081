#include <slamot/eval/Record.h>

namespace slamot::eval
{
Record ofPoint(Record record, const Point2D& point_robot)
{
  const Pose2D arm(point_robot.x, point_robot.y, 0);
  for (RobotRow& row : record.rows)
  {
    row.robot = math::compose(row.robot, {arm, Matrix3::Zero()});
    row.odometry = math::compose(row.odometry, arm);
  }
  record.lasers.clear();
  record.path = {};
  return record;
}
}  // namespace slamot::eval
