#pragma once

#include <slamot/importers/HeldMotion.h>
#include <slamot/importers/TextTable.h>

namespace slamot::importers
{
/// A step of odometry, from one time to the next [s].
struct OdometryStep
{
  double begin = 0, end = 0;
  HeldMotion motion;
};

/// odometry.csv in either form.
class CsvOdometry
{
 public:
  CsvOdometry(const std::string& folder, double startTime);

  /// The next step; rows of equal time make one.
  std::optional<OdometryStep> next();
  [[nodiscard]] double progress() const { return table_.progress(); }

 private:
  bool read();
  [[nodiscard]] HeldMotion rowMotion() const;
  [[nodiscard]] bool atRest(const Gaussian<Pose2D>& motion) const;

  TextTable table_;
  bool velocities_ = false;
  bool ahead_ = false;  // whether the table stands at a row not yet used
  double start_, last_ = start_, time_ = start_;
};
}  // namespace slamot::importers
