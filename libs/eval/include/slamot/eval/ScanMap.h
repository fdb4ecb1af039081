#pragma once

#include <slamot/eval/Record.h>

namespace slamot::eval
{
/// The scans of a record without the returns of its targets: those nearer than `radius` [m] to
/// where one was thought to be at the scan's row become "no return".
[[nodiscard]] std::vector<LaserRow> withoutTargets(const Record& record, double radius = 0.5);

/// Whose poses scans are drawn from.
enum class PosesOf
{
  kFilter,   ///< its estimates, each made when its scan came
  kPath,     ///< as it believes at the end; scans that this has no pose for are left out
  kOdometry  ///< odometry alone, summed up from the start
};
/// The returns of a record's scans, up to 30 m, in map axes [m]; evenly thinned to 200 000.
[[nodiscard]] std::vector<Point2D> scanPoints(const Record& record, PosesOf poses);

/// Mean map entropy, in natural units: how blurred a map of points is, without knowing the truth.
/// Each point with five neighbours or more within `radius` [m] counts as 1/2 ln det(2 pi e S), S
/// their covariance, to which a laser's rounding (0.01 m) is added; the mean is less the sharper
/// the map.  Of one log, paths can be compared by it, not logs with each other.  Droeschel and
/// Behnke, "Local multi-resolution representation for 6D motion estimation and mapping", 2014.
/// \returns none where no point has neighbours.
[[nodiscard]] std::optional<double> meanMapEntropy(const std::vector<Point2D>& points,
                                                   double radius = 0.3);

/// How sharp a run's scans make a map, beside that of its final path and of odometry alone.
struct ScanMapQuality
{
  std::size_t points = 0;         ///< of the map by the filter's estimates
  std::optional<double> entropy;  ///< of the map by the filter's estimates; see meanMapEntropy()
  std::optional<double> odometryEntropy;  ///< of the map by odometry alone
  std::optional<double> pathEntropy;      ///< none: the filter keeps no path
};
/// None of a record without scans.
[[nodiscard]] std::optional<ScanMapQuality> scanMapQuality(const Record& record);
}  // namespace slamot::eval
