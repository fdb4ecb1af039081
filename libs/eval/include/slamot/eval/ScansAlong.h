#pragma once

#include <slamot/core/run.h>
#include <slamot/eval/Record.h>

namespace slamot::eval
{
/// A log's laser scans, where a path has them.
struct ScansAlong
{
  /// A row for each scan that is kept, and the scans; targets where the path's record has them.
  /// Odometry is summed up from the path's pose at the first row.
  Record record;
  std::size_t leftOut = 0;  ///< scans of times at which the path has no pose
};
/// \param maxGap between two poses of the path, farther apart none is told [s].
/// Kept are scans as in a run's record: one for each 0.1 m or 5 degrees of motion.
[[nodiscard]] ScansAlong scansAlong(const Record& path, core::Source& log, double maxGap = 2);
}  // namespace slamot::eval
