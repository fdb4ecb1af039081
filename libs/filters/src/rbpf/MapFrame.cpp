#include "MapFrame.h"

namespace slamot::filters::rbpf
{
Matrix3 MapFrame::covAt(double x, double y) const
{
  Matrix3 T = Matrix3::Identity();  // of a pose there, by the first pose
  T(0, 2) = first_.mean.y - y;
  T(1, 2) = x - first_.mean.x;
  return T * first_.cov * T.transpose();
}

void MapFrame::addTo(core::TargetEstimate& target) const
{
  addTo(target.pose);
  const Vector2 turned(-target.velocity[1], target.velocity[0]);
  target.velocityCov += first_.cov(2, 2) * turned * turned.transpose();
}
}  // namespace slamot::filters::rbpf
