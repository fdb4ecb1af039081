#pragma once

#include <slamot/importers/WheelNoise.h>

#include "MrclamData.h"

namespace slamot::importers::mrclam
{
/// Odometry's velocities, each held until the next row.
class Wheels
{
 public:
  /// \param delay [s] is added to the rows' times.
  Wheels(std::vector<Velocity> rows, double delay, const WheelNoise& noise);

  [[nodiscard]] double begin() const { return rows_.front().time; }
  [[nodiscard]] double end() const { return rows_.back().time; }

  /// The motion between two times; calls come in rising order of time.
  Gaussian<Pose2D> between(double from, double to);

 private:
  std::vector<Velocity> rows_;
  WheelNoise noise_;
  std::size_t row_ = 0;
};
}  // namespace slamot::importers::mrclam
