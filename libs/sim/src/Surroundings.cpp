#include "Surroundings.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace slamot::sim
{
namespace
{
constexpr double kWallHeight = 2.5;  // [m]
constexpr double kLightFrom = 1.0;   // [rad], in the map
const Look kWallLook{0, kWallHeight, 40, 0.08, 0.75};

/// Of a surface whose normal points to `angle`.
double facing(double angle)
{
  return std::max(0.0, std::cos(angle - kLightFrom));
}
}  // namespace

void Surroundings::hitsAlong(const Point2D& from, double angle, std::vector<Hit>& out) const
{
  out.clear();
  const double c = std::cos(angle), s = std::sin(angle);
  for (const Thing& t : things_)
  {
    const double dx = t.at.x - from.x, dy = t.at.y - from.y, r = t.look.radius;
    const double along = c * dx + s * dy, across = c * dy - s * dx;
    if (std::abs(across) >= r) continue;
    const double distance = along - std::sqrt(r * r - across * across);
    if (distance <= 0) continue;
    const double x = from.x + distance * c - t.at.x, y = from.y + distance * s - t.at.y;
    out.push_back({distance, t.look.height, facing(std::atan2(y, x)), &t.look});
  }
  for (const Wall& w : walls_)
  {
    const double ex = w.to.x - w.from.x, ey = w.to.y - w.from.y, det = c * ey - s * ex;
    if (std::abs(det) < 1e-12) continue;
    const double dx = w.from.x - from.x, dy = w.from.y - from.y;
    const double distance = (dx * ey - dy * ex) / det, part = (dx * s - dy * c) / det;
    if (distance <= 0 || part < 0 || part > 1) continue;
    double normal = std::atan2(ex, -ey);
    if (std::cos(normal) * c + std::sin(normal) * s > 0) normal += math::kPi;
    out.push_back({distance, kWallHeight, facing(normal), &kWallLook});
  }
  std::sort(out.begin(), out.end(),
            [](const Hit& a, const Hit& b) { return a.distance > b.distance; });
}

double Surroundings::range(const Point2D& from, double angle) const
{
  std::vector<Hit> hits;
  hitsAlong(from, angle, hits);
  return hits.empty() ? std::numeric_limits<double>::infinity() : hits.back().distance;
}

core::LaserScan castScan(const Surroundings& world, const Pose2D& robot, const LaserSetup& laser,
                         math::RandomStream random)
{
  constexpr double kEdge = 0.3;  // [m], between what a mixed pixel lies between
  core::LaserScan out;
  out.pose_robot_sensor = laser.pose;
  out.angleMin = -0.5 * laser.fieldOfView;
  out.angleStep = laser.fieldOfView / (laser.beams - 1);
  out.rangeMax = laser.rangeMax;
  const Pose2D sensor = math::compose(robot, laser.pose);
  const Point2D from{sensor.x, sensor.y};
  for (int i = 0; i < laser.beams; ++i)
  {
    const double angle = sensor.phi + out.angleMin + i * out.angleStep;
    const double noise = laser.rangeStd * random.normal(), chance = random.uniform();
    const double between = random.uniform();
    double range = world.range(from, angle);
    if (chance < laser.mixedPixels)
    {
      const double half = 0.5 * out.angleStep;
      const double a = std::min(laser.rangeMax, world.range(from, angle - half));
      const double b = std::min(laser.rangeMax, world.range(from, angle + half));
      if (std::abs(a - b) > kEdge) range = a + between * (b - a);
    }
    range += noise;
    out.ranges.push_back(range > 0 && range < laser.rangeMax
                             ? static_cast<float>(range)
                             : std::numeric_limits<float>::infinity());
  }
  return out;
}
}  // namespace slamot::sim
