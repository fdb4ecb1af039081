#include <slamot/models/RangeBearing.h>

namespace slamot::models
{
RangeBearing::Jacobians RangeBearing::jacobians(const Pose2D& pose, const Point2D& point)
{
  const double dx = point.x - pose.x, dy = point.y - pose.y;
  const double q = dx * dx + dy * dy, r = std::sqrt(q);
  if (!(r >= kSmallestRange))
    throw std::domain_error("range below 1 cm: bearing has no derivative");
  Jacobians J;
  J.point << dx / r, dy / r, -dy / q, dx / q;
  J.pose << -J.point, Vector2(0.0, -1.0);
  return J;
}
}  // namespace slamot::models
