#pragma once

#include <slamot/math/gaussian.h>

#include <algorithm>
#include <utility>

namespace slamot::models
{
/// Variance of a heading of which nothing is known: uniform over a full turn.
inline constexpr double kUnknownHeadingVar = math::kPi * math::kPi / 3.0;

/// Heading and its variance of a velocity: first order, at most that of an unknown one.
inline std::pair<double, double> headingOf(const Vector2& v, const Matrix2& cov)
{
  const double q = v.squaredNorm();
  if (q <= 0) return {0.0, kUnknownHeadingVar};
  const Vector2 across(-v[1] / q, v[0] / q);
  return {std::atan2(v[1], v[0]), std::min(kUnknownHeadingVar, across.dot(cov * across))};
}

/// Pose of a target known by place and velocity: it heads where it goes.
inline Gaussian<Pose2D> poseOf(const Point2D& place, const Matrix2& cov, const Vector2& velocity,
                               const Matrix2& velocityCov)
{
  Gaussian<Pose2D> out;
  const auto [course, courseVar] = headingOf(velocity, velocityCov);
  out.mean = {place.x, place.y, course};
  out.cov.topLeftCorner<2, 2>() = cov;
  out.cov(2, 2) = courseVar;
  return out;
}
}  // namespace slamot::models
