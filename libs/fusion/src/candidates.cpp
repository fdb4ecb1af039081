#include <slamot/fusion/candidates.h>
#include <slamot/models/RangeBearing.h>

namespace slamot::fusion
{
using core::RobotAndTarget;
using models::RangeBearing;

Eigen::Matrix<double, 2, 3> placeByPose(const Candidate& c, double senderHeading)
{
  const double angle = senderHeading + c.bearing;
  Eigen::Matrix<double, 2, 3> F;
  F << 1, 0, -c.range * std::sin(angle), 0, 1, c.range * std::cos(angle);
  return F;
}

SeenPlace placeOf(const Candidate& c, const RobotAndTarget& sender, int targetSize)
{
  const Pose2D pose{sender.mean[0], sender.mean[1], sender.mean[2]};
  const RangeBearing::Z z(c.range, c.bearing);
  const int n = RobotAndTarget::kRobot + targetSize, m = 2 + targetSize;
  Eigen::MatrixXd F = Eigen::MatrixXd::Zero(m, n);
  F.leftCols(3).topRows(2) = placeByPose(c, pose.phi);
  F.bottomRightCorner(targetSize, targetSize).setIdentity();

  SeenPlace out;
  const Point2D place = RangeBearing::invert(pose, z);
  out.mean.resize(m);
  out.mean << place.x, place.y, sender.mean.segment(RobotAndTarget::kRobot, targetSize);
  const Matrix2 Fz = RangeBearing::invertJacobian(pose, z);
  const Matrix2 noise = RangeBearing(c.rangeStd, c.bearingStd).noise();
  out.independent = Eigen::MatrixXd::Zero(m, m);
  out.independent.topLeftCorner(2, 2) = Fz * noise * Fz.transpose();
  out.cov = F * sender.cov.topLeftCorner(n, n) * F.transpose() + out.independent;
  for (Eigen::MatrixXd* M : {&out.independent, &out.cov}) *M = (0.5 * (*M + M->transpose())).eval();
  return out;
}
}  // namespace slamot::fusion
