#pragma once

#include <slamot/core/Step.h>
#include <slamot/math/random.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace slamot::test
{
struct Segment
{
  Point2D a, b;  ///< [m]
};
using Walls = std::vector<Segment>;

/// The sides of a rectangle.
inline void addBox(Walls& walls, double x0, double y0, double x1, double y1)
{
  const Point2D p[] = {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
  for (int i = 0; i < 4; ++i) walls.push_back({p[i], p[(i + 1) % 4]});
}

/// A room 8 m by 6 m with a cupboard and a pillar: no two poses see the same.
inline Walls room()
{
  Walls walls;
  addBox(walls, 0, 0, 8, 6);
  addBox(walls, 0, 4.5, 1.2, 6);
  addBox(walls, 5, 2, 5.4, 2.4);
  return walls;
}

/// A corridor around a block, 2 m wide, 24 m by 16 m, with cupboards at places along it.
inline Walls ringCorridor()
{
  Walls walls;
  addBox(walls, 0, 0, 24, 16);
  addBox(walls, 2, 2, 22, 14);
  for (const double x : {3.0, 7.5, 9.0, 15.0, 19.5}) addBox(walls, x, 0, x + 0.5, 0.3);
  for (const double x : {4.0, 6.5, 12.0, 13.5, 20.0}) addBox(walls, x, 15.6, x + 0.7, 16);
  for (const double y : {3.0, 6.0, 7.0, 11.5})
  {
    addBox(walls, 23.6, y, 24, y + 0.6);
    addBox(walls, 0, y + 1, 0.4, y + 1.3);
  }
  return walls;
}

/// How far a ray goes [m]; infinite where it meets nothing.
inline double rayLength(const Walls& walls, const Pose2D& ray)
{
  const double dx = std::cos(ray.phi), dy = std::sin(ray.phi);
  double best = std::numeric_limits<double>::infinity();
  for (const Segment& s : walls)
  {
    const double ex = s.b.x - s.a.x, ey = s.b.y - s.a.y;
    const double det = ex * dy - ey * dx;
    if (std::abs(det) < 1e-12) continue;
    const double ax = s.a.x - ray.x, ay = s.a.y - ray.y;
    const double r = (ex * ay - ey * ax) / det, u = (dx * ay - dy * ax) / det;
    if (r > 0 && u >= 0 && u <= 1) best = std::min(best, r);
  }
  return best;
}

/// A scan of half a turn, 1 degree a beam.
inline std::shared_ptr<core::LaserScan> scanFrom(const Walls& walls, const Pose2D& pose,
                                                 math::RandomStream& random, double rangeStd = 0.02)
{
  auto scan = std::make_shared<core::LaserScan>();
  scan->angleMin = -math::kPi / 2;
  scan->angleStep = math::degToRad(1);
  scan->rangeMax = 30;
  for (int i = 0; i <= 180; ++i)
  {
    const double angle = scan->angleMin + i * scan->angleStep;
    const double r = rayLength(walls, {pose.x, pose.y, pose.phi + angle});
    scan->ranges.push_back(static_cast<float>(r + rangeStd * random.normal()));
  }
  return scan;
}

/// A drive along corners at 0.2 m a step, turning 0.2 rad a step in place.
inline std::vector<Pose2D> driveAlong(const std::vector<Point2D>& corners)
{
  std::vector<Pose2D> out;
  const double first = std::atan2(corners[1].y - corners[0].y, corners[1].x - corners[0].x);
  Pose2D pose{corners[0].x, corners[0].y, first};
  out.push_back(pose);
  for (std::size_t i = 1; i < corners.size(); ++i)
  {
    const double dx = corners[i].x - pose.x, dy = corners[i].y - pose.y;
    const double turn = math::wrapToPi(std::atan2(dy, dx) - pose.phi);
    const int turns = static_cast<int>(std::ceil(std::abs(turn) / 0.2));
    for (int k = 0; k < turns; ++k)
      out.push_back(pose = {pose.x, pose.y, math::wrapToPi(pose.phi + turn / turns)});
    const int moves = static_cast<int>(std::ceil(std::hypot(dx, dy) / 0.2));
    for (int k = 0; k < moves; ++k)
      out.push_back(pose = {pose.x + dx / moves, pose.y + dy / moves, pose.phi});
  }
  return out;
}

/// What a robot reports of a drive: noisy odometry that besides drifts, and a scan a step.
inline std::vector<core::Step> stepsOf(const Walls& walls, const std::vector<Pose2D>& drive,
                                       std::uint64_t seed, double turnBias = 0.01)
{
  math::RandomStream random{seed};
  std::vector<core::Step> out;
  for (std::size_t i = 0; i < drive.size(); ++i)
  {
    core::Step step;
    step.time = static_cast<double>(i);
    if (i > 0)
    {
      const Pose2D moved = math::between(drive[i - 1], drive[i]);
      Gaussian<Pose2D> odometry;
      odometry.cov.diagonal() = Vector3(4e-4, 4e-4, 4e-4);
      odometry.mean = {moved.x + 0.02 * random.normal(), moved.y + 0.02 * random.normal(),
                       moved.phi + 0.02 * random.normal() + turnBias};
      step.odometry = odometry;
    }
    step.lasers.push_back(scanFrom(walls, drive[i], random));
    out.push_back(std::move(step));
  }
  return out;
}

/// Walls as points, 5 cm apart.
inline std::vector<Point2D> pointsAlong(const Walls& walls)
{
  std::vector<Point2D> out;
  for (const Segment& s : walls)
  {
    const int n = static_cast<int>(std::ceil(std::hypot(s.b.x - s.a.x, s.b.y - s.a.y) / 0.05));
    for (int i = 0; i <= n; ++i)
      out.push_back({s.a.x + (s.b.x - s.a.x) * i / n, s.a.y + (s.b.y - s.a.y) * i / n});
  }
  return out;
}
}  // namespace slamot::test
