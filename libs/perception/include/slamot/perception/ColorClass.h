#pragma once

#include <slamot/core/Params.h>
#include <slamot/perception/fitCircle.h>

#include <string>

namespace slamot::perception
{
/// A part of the HSV colour space: hue [deg, 0 to 360], saturation and value [0 to 1].  Where
/// hueMin is above hueMax, hues run from hueMin through 360 to hueMax, as reds do.
struct HsvRange
{
  double hueMin = 0;         ///< [deg]
  double hueMax = 360;       ///< [deg]
  double saturationMin = 0;  ///< 0: grey
  double saturationMax = 1;  ///< 1: pure
  double valueMin = 0;       ///< 0: black
  double valueMax = 1;       ///< 1: as bright as can be

  /// Keys hue_min_deg, hue_max_deg, saturation_min, saturation_max, value_min, value_max.
  static HsvRange from(core::Params& p);
  /// Those keys, as lines of an ini file.
  [[nodiscard]] std::string toIni() const;
};

/// How far a class follows the light: hue shifted, saturation and value multiplied, as the class's
/// largest blob changes against its first one.
struct LightTracking
{
  double rate = 0;           ///< part of a change taken at each image; 0: none [0 to 1]
  double mostHueShift = 15;  ///< [deg]
  double mostFactor = 2.5;   ///< of saturation and value, either way
};

/// A colour that stands for a kind of thing, and what its patches look like.
struct ColorClass
{
  std::string label;  ///< of its blobs: "target", "robot", ...
  int id = -1;        ///< identity of the one thing that has this colour; -1: there may be several
  HsvRange range;     ///< its colour
  double leastArea = 30;        ///< [pixel²]
  double leastFill = 0.3;       ///< part of its box that a blob covers [0 to 1]
  double mostOfImage = 0.5;     ///< a blob that covers more is no object [0 to 1]
  int joinGap = 2;              ///< pieces with no more than this between them are one blob [pixel]
  Roundness object{0.2, 0.05};  ///< outline of the thing, as a laser sees it
  LightTracking light;          ///< how far that follows the light

  /// Section `[color.<label>]`.  \throws core::Error (kConfig).
  static ColorClass from(core::Params& p, const std::string& label);
};
}  // namespace slamot::perception
