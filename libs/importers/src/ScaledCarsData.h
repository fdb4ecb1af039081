#pragma once

#include <slamot/core/Step.h>
#include <slamot/importers/ScaledCars.h>
#include <slamot/importers/TextTable.h>

#include <array>
#include <map>
#include <memory>
#include <vector>

/// The tables of one run of the scaled cars.
namespace slamot::importers::scaled_cars
{
inline constexpr int kBeams = 360;

struct WheelSpeeds
{
  double time = 0;
  std::array<double, 4> speed{};  ///< front left, front right, back left, back right [rad/s]
};
struct TurnRate
{
  double time = 0, rate = 0;  ///< [s, rad/s]
};

/// At least one row each, in rising order of time, none farther apart than 1 s.
std::vector<WheelSpeeds> readWheels(const std::string& folder);
std::vector<TurnRate> readTurnRates(const std::string& folder);

/// The motion-capture pose of a car, `<name>_pose.csv`; empty if the run has none.
eval::Trajectory readPoses(const std::string& folder, const std::string& name);
/// Those of target_pose.csv (1) and target<id>_pose.csv.
std::map<int, eval::Trajectory> readTargets(const std::string& folder);

/// The laser's scans, one after the other.
class LaserScans
{
 public:
  LaserScans(const std::string& folder, const ScaledCarsOptions& options);

  /// When the next one was taken; none at the end.
  [[nodiscard]] std::optional<double> time() const { return time_; }
  /// The next one.  Only if there is one.
  std::shared_ptr<const core::LaserScan> take();
  [[nodiscard]] double progress() const { return table_.progress(); }

 private:
  void advance();

  const ScaledCarsOptions* options_;
  TextTable table_;
  std::optional<double> logged_, time_;
};
}  // namespace slamot::importers::scaled_cars
