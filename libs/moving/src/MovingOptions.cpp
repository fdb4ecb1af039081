#include <slamot/moving/MovingOptions.h>

namespace slamot::moving
{
namespace
{
Extent extentFrom(core::Params& p, const std::string& name, const Extent& otherwise)
{
  return {p.positive(name + "_m", otherwise.mean), p.positive(name + "_std_m", otherwise.std)};
}
}  // namespace

MovingOptions MovingOptions::from(core::Params& p)
{
  MovingOptions out;
  perception::LaserOptions laser;
  laser.flattest = math::degToRad(25.0);  // what stands just behind a thing is not of it
  out.laser = perception::LaserOptions::from(p, laser);
  out.freeSpace.cell = p.inRange("cell_m", 0.01, 2, out.freeSpace.cell);
  out.freeSpace.margin = p.positive("free_margin_m", out.freeSpace.margin);
  out.freeSpace.marginPerRange =
      p.nonNegative("free_margin_per_range", out.freeSpace.marginPerRange);
  out.freeSpace.remember = p.positive("remember_s", out.freeSpace.remember);
  out.shape = p.choice("shape", {"rectangle", "centre"}, "rectangle") == "centre" ? Shape::kCentre
                                                                                  : out.shape;
  out.length = extentFrom(p, "length", out.length);
  out.width = extentFrom(p, "width", out.width);
  constexpr double kRearAxle = 0.3;  // of a car's length behind its middle
  out.axleBehind = p.number("axle_behind_m", kRearAxle * out.length.mean);
  out.reportAhead = p.number("report_ahead_m", out.reportAhead);
  out.shapeStd = p.positive("shape_std_m", out.shapeStd);
  out.speedWalk = p.positive("target_speed_walk_mps_per_sqrt_s", out.speedWalk);
  out.turnWalk = p.positive("target_turn_rate_walk_deg_per_s_per_sqrt_s", out.turnWalk);
  out.slide = p.nonNegative("target_slide_m_per_sqrt_s", out.slide);
  out.maxSize = p.positive("max_size_m", out.maxSize);
  out.minPoints = p.integer("min_points", 2, 1000, out.minPoints);
  out.confirmDistance = p.positive("confirm_distance_m", out.confirmDistance);
  out.confirmTime = p.positive("confirm_time_s", out.confirmTime);
  out.confirmScans = p.integer("confirm_scans", 2, 1000, out.confirmScans);
  out.confirmFree = p.inRange("confirm_free", 0, 1, out.confirmFree);
  out.tentativeTime = p.positive("tentative_time_s", out.tentativeTime);
  out.lostTime = p.positive("lost_time_s", out.lostTime);
  out.seenThrough = p.integer("seen_through_scans", 1, 1000, out.seenThrough);
  return out;
}
}  // namespace slamot::moving
