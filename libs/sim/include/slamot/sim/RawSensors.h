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
  double radius = 0.1;      ///< [m]
  double height = 1;        ///< [m]
  double hue = 60;          ///< [deg, 0 to 360]
  double saturation = 0.1;  ///< 0: grey, 1: pure
  double value = 0.5;       ///< brightness in full light [0 to 1]

  /// Keys radius_m, height_m, hue_deg, saturation, value, each after `prefix`.
  static Look from(core::Params& p, const Look& otherwise, const std::string& prefix = "");
};

/// An upright wall, seen from both sides.
struct Wall
{
  Point2D from;  ///< in the map frame [m]
  Point2D to;    ///< in the map frame [m]
};

/// A laser scanner.
struct LaserSetup
{
  Pose2D pose;             ///< on the robot
  int beams = 361;         ///< ranges in a scan
  double fieldOfView = 0;  ///< from the first beam to the last, about its axis [rad]
  double rangeMax = 30;    ///< beyond it there is no return [m]
  double rangeStd = 0.02;  ///< of a range [m]
  /// A beam that an edge parts gives, with this chance, a range between the two: as wide as the gap
  /// between beams it is.
  double mixedPixels = 0;
  int every = 1;  ///< steps from one scan to the next

  /// Section [laser]. \throws core::Error (kConfig)
  static LaserSetup from(core::Params& p);
};

/// A camera without distortion.
struct CameraSetup
{
  int width = 640;     ///< [pixel]
  int height = 480;    ///< [pixel]
  double focal = 500;  ///< [pixel]
  double x = 0;        ///< on the robot, ahead [m]
  double y = 0;        ///< on the robot, to the left [m]
  double z = 0.5;      ///< above the floor [m]
  double yaw = 0;      ///< [rad]
  double noise = 4;    ///< of each pixel, of 255

  double lightSwing = 0;    ///< brightness swings about 1 by this part ...
  double lightPeriod = 20;  ///< ... in so many seconds
  int every = 1;            ///< steps from one image to the next

  /// Section [camera]. \throws core::Error (kConfig)
  static CameraSetup from(core::Params& p);
};

/// An image, rows from the top, three bytes a pixel: blue, green, red.
struct Picture
{
  int width = 0;                  ///< [pixel]
  int height = 0;                 ///< [pixel]
  std::vector<std::uint8_t> bgr;  ///< width times height times three
};
}  // namespace slamot::sim
