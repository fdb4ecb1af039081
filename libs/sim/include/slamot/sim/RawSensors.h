#pragma once

#include <slamot/core/Params.h>
#include <slamot/math/geometry.h>

#include <cstdint>
#include <vector>

namespace slamot::sim
{
/// What a thing looks like to lasers and cameras: an upright cylinder on the floor.
struct Look
{
  double radius = 0.1, height = 1;    ///< [m]
  double hue = 60, saturation = 0.1;  ///< [deg, 0 to 1]
  double value = 0.5;                 ///< brightness in full light [0 to 1]

  /// Keys radius_m, height_m, hue_deg, saturation, value, each after `prefix`.
  static Look from(core::Params& p, const Look& otherwise, const std::string& prefix = "");
};

/// An upright wall, seen from both sides.
struct Wall
{
  Point2D from, to;  ///< [m]
};

/// A laser scanner.
struct LaserSetup
{
  Pose2D pose;  ///< on the robot
  int beams = 361;
  double fieldOfView = 0;                 ///< from the first beam to the last, about its axis [rad]
  double rangeMax = 30, rangeStd = 0.02;  ///< [m]
  /// A beam that an edge parts gives, with this chance, a range between the two: as wide as the gap
  /// between beams it is.
  double mixedPixels = 0;
  int every = 1;  ///< steps from one scan to the next

  static LaserSetup from(core::Params& p);
};

/// A camera without distortion.
struct CameraSetup
{
  int width = 640, height = 480;  ///< [pixel]
  double focal = 500;             ///< [pixel]
  double x = 0, y = 0, z = 0.5;   ///< on the robot [m]
  double yaw = 0;                 ///< [rad]
  double noise = 4;               ///< of each pixel, of 255
  /// Brightness swings about 1 by this part, in so many seconds.
  double lightSwing = 0, lightPeriod = 20;
  int every = 1;  ///< steps from one image to the next

  static CameraSetup from(core::Params& p);
};

/// An image, rows from the top, three bytes a pixel: blue, green, red.
struct Picture
{
  int width = 0, height = 0;
  std::vector<std::uint8_t> bgr;
};
}  // namespace slamot::sim
