#pragma once

#include <slamot/core/Step.h>
#include <slamot/sim/RawSensors.h>

#include "streams.h"

namespace slamot::sim
{
/// What stands around a robot at one instant, for its laser and camera.
class Surroundings
{
 public:
  void add(const Point2D& at, const Look& look) { things_.push_back({at, look}); }
  void add(const std::vector<Wall>& walls) { walls_ = walls; }

  /// What a ray meets.
  struct Hit
  {
    double distance = 0;  ///< [m]
    double height = 0;    ///< of the thing [m]
    double facing = 1;    ///< how much it faces the light, 0 to 1
    const Look* look = nullptr;
  };
  /// All that a ray from a point meets, the farthest first.
  void hitsAlong(const Point2D& from, double angle, std::vector<Hit>& out) const;
  /// Range of the first; infinity for none.
  [[nodiscard]] double range(const Point2D& from, double angle) const;

 private:
  struct Thing
  {
    Point2D at;
    Look look;
  };
  std::vector<Thing> things_;
  std::vector<Wall> walls_;
};

/// One scan; equal random streams give equal scans.
[[nodiscard]] core::LaserScan castScan(const Surroundings& world, const Pose2D& robot,
                                       const LaserSetup& laser, math::RandomStream random);

/// One image, with light from one side; nearer things hide what is behind and below their tops.
[[nodiscard]] Picture drawPicture(const Surroundings& world, const Pose2D& robot,
                                  const CameraSetup& camera, double time,
                                  math::RandomStream random);
}  // namespace slamot::sim
