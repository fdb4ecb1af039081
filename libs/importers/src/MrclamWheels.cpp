#include "MrclamWheels.h"

#include <algorithm>

namespace slamot::importers::mrclam
{
Wheels::Wheels(std::vector<Velocity> rows, double delay, const WheelNoise& noise)
    : rows_(std::move(rows)), noise_(noise)
{
  for (Velocity& row : rows_) row.time += delay;
}

Gaussian<Pose2D> Wheels::between(double from, double to)
{
  Gaussian<Pose2D> sum;
  while (from < to)
  {
    while (row_ + 1 < rows_.size() && rows_[row_ + 1].time <= from) ++row_;
    const double until = row_ + 1 < rows_.size() ? std::min(to, rows_[row_ + 1].time) : to;
    sum = math::compose(sum, noise_.held(rows_[row_].v, rows_[row_].omega, until - from));
    from = until;
  }
  return sum;
}
}  // namespace slamot::importers::mrclam
