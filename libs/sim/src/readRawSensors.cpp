#include <slamot/math/geometry.h>
#include <slamot/sim/RawSensors.h>

namespace slamot::sim
{
Look Look::from(core::Params& p, const Look& otherwise, const std::string& prefix)
{
  Look out;
  out.radius = p.positive(prefix + "radius_m", otherwise.radius);
  out.height = p.positive(prefix + "height_m", otherwise.height);
  out.hue = math::radToDeg(
      p.inRange(prefix + "hue_deg", 0, 360, math::degToRad(otherwise.hue)));  // an image's angle
  out.saturation = p.inRange(prefix + "saturation", 0, 1, otherwise.saturation);
  out.value = p.inRange(prefix + "value", 0, 1, otherwise.value);
  return out;
}

LaserSetup LaserSetup::from(core::Params& p)
{
  LaserSetup out;
  out.pose = {p.number("x_m", 0.0), p.number("y_m", 0.0), p.inRange("yaw_deg", -180, 180, 0.0)};
  out.beams = p.integer("beams", 2, 100000, out.beams);
  out.fieldOfView = p.inRange("fov_deg", 1, 360, math::kPi);
  out.rangeMax = p.positive("range_max_m", out.rangeMax);
  out.rangeStd = p.nonNegative("range_std_m", out.rangeStd);
  out.mixedPixels = p.inRange("mixed_pixel_probability", 0, 1, out.mixedPixels);
  out.every = p.integer("scan_every", 1, 10'000'000, out.every);
  return out;
}

CameraSetup CameraSetup::from(core::Params& p)
{
  CameraSetup out;
  out.width = p.integer("width_px", 1, 10000, out.width);
  out.height = p.integer("height_px", 1, 10000, out.height);
  out.focal = p.positive("focal_length_px", out.focal);
  out.x = p.number("x_m", out.x);
  out.y = p.number("y_m", out.y);
  out.z = p.positive("z_m", out.z);
  out.yaw = p.inRange("yaw_deg", -180, 180, out.yaw);
  out.noise = p.nonNegative("pixel_noise", out.noise);
  out.lightSwing = p.inRange("light_swing", 0, 0.9, out.lightSwing);
  out.lightPeriod = p.positive("light_period_s", out.lightPeriod);
  out.every = p.integer("image_every", 1, 10'000'000, out.every);
  return out;
}
}  // namespace slamot::sim
