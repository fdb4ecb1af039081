#include "readSections.h"

namespace slamot::sim
{
namespace
{
constexpr double kMostClutter = 500;  // what the Poisson draw is good for

/// \param positions whether its errors are those of places.
SensorSetup readSensor(core::Params& p, bool positions = false)
{
  SensorSetup s;
  s.fov.rangeMin = p.nonNegative("range_min_m", 0.0);
  s.fov.rangeMax = p.positive("range_max_m");
  if (s.fov.rangeMax <= s.fov.rangeMin)
    p.fail("range_max_m", "is not above range_min_m", "raise it");
  s.fov.bearingMin = p.inRange("bearing_min_deg", -180, 180, -math::kPi);
  s.fov.bearingMax = p.inRange("bearing_max_deg", -180, 180, math::kPi);
  if (s.fov.bearingMax <= s.fov.bearingMin)
    p.fail("bearing_max_deg", "is not above bearing_min_deg", "raise it");
  if (positions)
    p.allowUnused({"range_std_m", "bearing_std_rad"});
  else
  {
    s.rangeStd = p.positive("range_std_m");
    s.bearingStd = p.positive("bearing_std_rad");
  }
  s.glint = models::NoiseLaw::from(p, "");
  s.detection = p.inRange("detection_probability", 0, 1, 1.0);
  s.clutter = p.inRange("clutter_per_scan", 0, kMostClutter, 0.0);
  s.identities = p.flag("identities", true);
  return s;
}
/// What target and mate sensor share.
SensorSetup readBlobSensor(core::Params& p, const std::string& clutterLabel)
{
  const double positionStd = p.nonNegative("position_std_m", 0.0);
  SensorSetup s = readSensor(p, positionStd > 0);
  s.positionStd = positionStd;
  s.bearingOnly = p.flag("bearing_only", false);
  if (s.bearingOnly && positionStd > 0)
    p.fail("position_std_m", "is of a place, which bearing_only leaves out", "set it to 0");
  s.clutterLabel = p.text("clutter_label", clutterLabel);
  return s;
}
}  // namespace

SensorSetup readLandmarkSensor(core::Config& config)
{
  core::Params p(config, "landmark_sensor");
  return readSensor(p);
}

std::optional<SensorSetup> readTargetSensor(core::Config& config, bool isNeeded)
{
  if (!isNeeded && !config.has("target_sensor")) return std::nullopt;
  core::Params p(config, "target_sensor");
  return readBlobSensor(p, "target");
}

std::optional<SensorSetup> readMateSensor(core::Config& config)
{
  if (!config.has("mate_sensor")) return std::nullopt;
  core::Params p(config, "mate_sensor");
  SensorSetup s = readBlobSensor(p, "robot");
  s.label = p.text("label", "robot");
  return s;
}
}  // namespace slamot::sim
