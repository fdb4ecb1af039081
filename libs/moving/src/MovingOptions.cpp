#include <slamot/moving/MovingOptions.h>

namespace slamot::moving
{
namespace
{
Extent extentFrom(core::Params& p, const std::string& name, const Extent& otherwise)
{
  return {p.inRange(name + "_m", 0.05, 20, otherwise.mean),
          p.inRange(name + "_std_m", 1e-4, 20, otherwise.std)};
}
}  // namespace

MovingOptions MovingOptions::from(core::Params& p)
{
  MovingOptions out;
  perception::LaserOptions laser;
  laser.flattest = math::degToRad(25.0);  // what stands just behind a thing is not of it
  out.laser = perception::LaserOptions::from(p, laser);
  if (out.laser.rangeStd < 1e-3 || out.laser.rangeStd > 1)
    p.fail("range_std_m", "is out of range", "give 0.001 to 1");
  out.freeSpace.cell = p.inRange("cell_m", 0.01, 2, out.freeSpace.cell);
  out.freeSpace.margin = p.inRange("free_margin_m", 0.01, 2, out.freeSpace.margin);
  out.freeSpace.marginPerRange =
      p.inRange("free_margin_per_range", 0, 0.5, out.freeSpace.marginPerRange);
  out.freeSpace.remember = p.positive("remember_s", out.freeSpace.remember);
  out.shape = p.choice("shape", {"rectangle", "centre"}, "rectangle") == "centre" ? Shape::kCentre
                                                                                  : out.shape;
  out.length = extentFrom(p, "length", out.length);
  out.width = extentFrom(p, "width", out.width);
  constexpr double kRearAxle = 0.3;  // of a car's length behind its middle
  out.axleBehind = p.inRange("axle_behind_m", -20, 20, kRearAxle * out.length.mean);
  out.reportAhead = p.inRange("report_ahead_m", -20, 20, out.reportAhead);
  out.shapeStd = p.inRange("shape_std_m", 1e-3, 1, out.shapeStd);
  out.speedWalk = p.inRange("target_speed_walk_mps_per_sqrt_s", 1e-3, 100, out.speedWalk);
  out.turnWalk = p.inRange("target_turn_rate_walk_deg_per_s_per_sqrt_s", 0.1, 10000, out.turnWalk);
  out.slide = p.inRange("target_slide_m_per_sqrt_s", 0, 10, out.slide);
  out.maxSize = p.inRange("max_size_m", 0.1, 50, out.maxSize);
  out.minPoints = p.integer("min_points", 2, 1000, out.minPoints);
  out.confirmDistance = p.inRange("confirm_distance_m", 0.01, 100, out.confirmDistance);
  out.confirmTime = p.positive("confirm_time_s", out.confirmTime);
  out.confirmScans = p.integer("confirm_scans", 2, 1000, out.confirmScans);
  out.confirmFree = p.inRange("confirm_free", 0, 1, out.confirmFree);
  out.tentativeTime = p.positive("tentative_time_s", out.tentativeTime);
  out.lostTime = p.positive("lost_time_s", out.lostTime);
  out.seenThrough = p.integer("seen_through_scans", 1, 1000, out.seenThrough);
  return out;
}
}  // namespace slamot::moving
