#pragma once

#include <slamot/core/Params.h>
#include <slamot/core/Step.h>

#include <vector>

namespace slamot::perception
{
/// A laser's return, in the robot's frame.
struct ScanPoint
{
  Point2D at;            ///< [m]
  double range = 0;      ///< from the laser [m]
  double angle = 0;      ///< of its beam, from the robot's heading [rad]
  std::size_t beam = 0;  ///< in the scan
};

/// Neighbouring returns that may be of one thing.
struct Cluster
{
  std::vector<ScanPoint> points;  ///< by rising angle
  /// Whether what lies beside it is farther away, so that its end is the thing's own: false where
  /// something nearer hides the rest, or the scan ends.
  bool freeRight = false;
  bool freeLeft = false;  ///< the same of its left end

  /// Between its first and last point [m].
  [[nodiscard]] double width() const;
};

/// The laser, and how its returns are put together.
struct LaserOptions
{
  double rangeStd = 0.02;  ///< of a return [m]
  double maxRange = 30;    ///< farther returns are left out [m]
  double jump = 0.1;       ///< least gap between things [m]
  double flattest =
      0.17453292519943295;  ///< least angle between a surface and the beams on it [rad]

  /// Keys range_std_m, max_range_m, jump_m, flattest_deg.
  static LaserOptions from(core::Params& p, const LaserOptions& otherwise);
  /// The same with the defaults above.
  static LaserOptions from(core::Params& p) { return from(p, {}); }
};

/// Parts a scan where the next return is farther off than a surface that the beams meet at
/// `flattest` would have it (Borges and Aldon 2004), plus `jump`.  A scan all round is closed.
[[nodiscard]] std::vector<Cluster> clustersOf(const core::LaserScan& scan,
                                              const LaserOptions& options);
}  // namespace slamot::perception
