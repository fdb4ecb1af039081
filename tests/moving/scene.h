#pragma once

#include "../perception/castScans.h"

// Rooms with boxes in them, in map axes, seen from a robot whose laser sees all round.
namespace slamot::moving::test
{
using perception::test::Wall;
using perception::test::World;

inline void addBox(World& world, const Pose2D& at, double length, double width)
{
  std::vector<Point2D> corners;
  for (const auto& [x, y] : {std::pair{1, 1}, {-1, 1}, {-1, -1}, {1, -1}})
    corners.push_back(math::transform(at, Point2D{0.5 * x * length, 0.5 * y * width}));
  for (std::size_t i = 0; i < 4; ++i) world.walls.push_back({corners[i], corners[(i + 1) % 4]});
}

/// One beam a degree, up to 12 m.
inline core::LaserScan lookRound(const World& world, const Pose2D& robot, double std,
                                 std::uint64_t seed)
{
  perception::test::Laser laser;
  laser.pose = robot;
  laser.angleMin = -math::kPi;
  laser.angleStep = math::kPi / 180;
  laser.beams = 360;
  laser.rangeMax = 12;
  laser.rangeStd = std;
  core::LaserScan scan = perception::test::scanOf(world, laser, seed);
  scan.pose_robot_sensor = {};
  return scan;
}
}  // namespace slamot::moving::test
