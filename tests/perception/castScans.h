#pragma once

#include <slamot/core/Step.h>
#include <slamot/math/random.h>

#include <limits>

// Scans of things whose places are known.
namespace slamot::perception::test
{
struct Circle
{
  Point2D at;
  double radius;
};
struct Wall
{
  Point2D from, to;
};
struct World
{
  std::vector<Circle> circles;
  std::vector<Wall> walls;
};
struct Laser
{
  Pose2D pose{0.1, 0, 0};
  double angleMin = -math::kPi / 2, angleStep = math::kPi / 360;
  std::size_t beams = 361;
  double rangeMax = 30, rangeStd = 0.02;
};

/// Range of the first thing on a beam; infinity for none.
inline double cast(const World& world, const Point2D& from, double angle)
{
  double best = std::numeric_limits<double>::infinity();
  const double c = std::cos(angle), s = std::sin(angle);
  for (const Circle& o : world.circles)
  {
    const double dx = o.at.x - from.x, dy = o.at.y - from.y;
    const double along = c * dx + s * dy, across = c * dy - s * dx;
    if (along <= 0 || std::abs(across) >= o.radius) continue;
    best = std::min(best, along - std::sqrt(o.radius * o.radius - across * across));
  }
  for (const Wall& w : world.walls)
  {
    const double ex = w.to.x - w.from.x, ey = w.to.y - w.from.y;
    const double det = c * ey - s * ex;
    if (std::abs(det) < 1e-12) continue;
    const double dx = w.from.x - from.x, dy = w.from.y - from.y;
    const double range = (dx * ey - dy * ex) / det, part = (dx * s - dy * c) / det;
    if (range > 0 && part >= 0 && part <= 1) best = std::min(best, range);
  }
  return best;
}

inline core::LaserScan scanOf(const World& world, const Laser& laser, std::uint64_t seed)
{
  math::RandomStream random{seed};
  core::LaserScan out;
  out.pose_robot_sensor = laser.pose;
  out.angleMin = laser.angleMin;
  out.angleStep = laser.angleStep;
  out.rangeMax = laser.rangeMax;
  for (std::size_t i = 0; i < laser.beams; ++i)
  {
    const double a = laser.pose.phi + laser.angleMin + static_cast<double>(i) * laser.angleStep;
    const double r =
        cast(world, {laser.pose.x, laser.pose.y}, a) + laser.rangeStd * random.normal();
    out.ranges.push_back(r < laser.rangeMax ? static_cast<float>(r)
                                            : std::numeric_limits<float>::infinity());
  }
  return out;
}
}  // namespace slamot::perception::test
