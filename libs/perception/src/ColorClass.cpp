#include <slamot/math/geometry.h>
#include <slamot/perception/ColorClass.h>

#include <cstdio>

namespace slamot::perception
{
namespace
{
constexpr double kFullTurn = 360;  // [deg]

// Hues stay in degrees: they are an image's, not the robot's.
double hue(core::Params& p, const std::string& key, double otherwise)
{
  return math::radToDeg(p.inRange(key, 0, kFullTurn, math::degToRad(otherwise)));
}
}  // namespace

HsvRange HsvRange::from(core::Params& p)
{
  HsvRange out;
  out.hueMin = hue(p, "hue_min_deg", out.hueMin);
  out.hueMax = hue(p, "hue_max_deg", out.hueMax);
  out.saturationMin = p.inRange("saturation_min", 0, 1, out.saturationMin);
  out.saturationMax = p.inRange("saturation_max", out.saturationMin, 1, out.saturationMax);
  out.valueMin = p.inRange("value_min", 0, 1, out.valueMin);
  out.valueMax = p.inRange("value_max", out.valueMin, 1, out.valueMax);
  return out;
}

std::string HsvRange::toIni() const
{
  char text[400];
  std::snprintf(text, sizeof text,
                "hue_min_deg    = %.0f\nhue_max_deg    = %.0f\n"
                "saturation_min = %.2f\nsaturation_max = %.2f\n"
                "value_min      = %.2f\nvalue_max      = %.2f\n",
                hueMin, hueMax, saturationMin, saturationMax, valueMin, valueMax);
  return text;
}

ColorClass ColorClass::from(core::Params& p, const std::string& label)
{
  ColorClass out;
  out.label = label;
  out.id = p.integer("id", -1, 1 << 30, out.id);
  out.range = HsvRange::from(p);
  out.leastArea = p.inRange("min_area_px", 1, 1e9, out.leastArea);
  out.leastFill = p.inRange("min_fill", 0, 1, out.leastFill);
  out.mostOfImage = p.inRange("max_image_part", 0, 1, out.mostOfImage);
  out.joinGap = p.integer("join_gap_px", 0, 1000, out.joinGap);
  out.object.radius = p.positive("radius_m", out.object.radius);
  out.object.radiusStd = p.positive("radius_std_m", out.object.radiusStd);
  out.light.rate = p.inRange("light_rate", 0, 1, out.light.rate);
  out.light.mostHueShift = math::radToDeg(
      p.inRange("light_max_hue_shift_deg", 0, 90, math::degToRad(out.light.mostHueShift)));
  out.light.mostFactor = p.inRange("light_max_factor", 1, 10, out.light.mostFactor);
  return out;
}
}  // namespace slamot::perception
