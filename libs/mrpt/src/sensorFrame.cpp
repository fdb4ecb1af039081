#include "sensorFrame.h"

#include <algorithm>
#include <cmath>

namespace slamot::mrpt
{
namespace
{
Vector3 direction(double yaw, double pitch)
{
  return {std::cos(pitch) * std::cos(yaw), std::cos(pitch) * std::sin(yaw), -std::sin(pitch)};
}
}  // namespace

SensorFrame::SensorFrame(const ::mrpt::poses::CPose3D& pose) : offset_(pose.x(), pose.y(), pose.z())
{
  const auto& r = pose.getRotationMatrix();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) rotation_(i, j) = r(i, j);
}

SensorFrame::RangeBearing SensorFrame::point(const Vector3& polar, const Matrix3& cov) const
{
  const double range = polar[0], yaw = polar[1], pitch = polar[2];
  const Vector3 p = rotation_ * (range * direction(yaw, pitch)) + offset_;
  const double rho = std::hypot(p[0], p[1]);
  if (rho <= 0) return {};

  Matrix3 point_by_polar;
  point_by_polar.col(0) = direction(yaw, pitch);
  point_by_polar.col(1) = range * std::cos(pitch) * Vector3(-std::sin(yaw), std::cos(yaw), 0);
  point_by_polar.col(2) = range * Vector3(-std::sin(pitch) * std::cos(yaw),
                                          -std::sin(pitch) * std::sin(yaw), -std::cos(pitch));
  Eigen::Matrix<double, 2, 3> plane_by_point;
  plane_by_point << p[0] / rho, p[1] / rho, 0, -p[1] / (rho * rho), p[0] / (rho * rho), 0;
  const Eigen::Matrix<double, 2, 3> j = plane_by_point * rotation_ * point_by_polar;
  const Matrix2 planeCov = j * cov * j.transpose();
  return {rho, std::atan2(p[1], p[0]), std::sqrt(planeCov(0, 0)), std::sqrt(planeCov(1, 1))};
}

double SensorFrame::bearing(double yaw, double pitch) const
{
  const Vector3 d = rotation_ * direction(yaw, pitch);
  return std::atan2(d[1], d[0]);
}

core::FieldOfView SensorFrame::view(core::FieldOfView fov) const
{
  if (fov.bearingMax - fov.bearingMin >= math::kTwoPi - 1e-6)
  {
    fov.bearingMin = -math::kPi, fov.bearingMax = math::kPi;
    return fov;
  }
  const double middle = 0.5 * (fov.bearingMin + fov.bearingMax);
  const double half = fov.bearingMax - middle;
  const double turned = bearing(middle, 0);
  fov.bearingMin = std::max(turned - half, -math::kPi);
  fov.bearingMax = std::min(turned + half, math::kPi);
  return fov;
}

core::FieldOfView join(const core::FieldOfView& a, const core::FieldOfView& b)
{
  const bool apart = a.bearingMax < b.bearingMin || b.bearingMax < a.bearingMin;
  if (apart) return a.bearingMax - a.bearingMin >= b.bearingMax - b.bearingMin ? a : b;
  return {std::min(a.rangeMin, b.rangeMin), std::max(a.rangeMax, b.rangeMax),
          std::min(a.bearingMin, b.bearingMin), std::max(a.bearingMax, b.bearingMax)};
}
}  // namespace slamot::mrpt
