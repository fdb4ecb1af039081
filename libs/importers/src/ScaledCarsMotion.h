#pragma once

#include <slamot/math/gaussian.h>

#include "ScaledCarsData.h"

namespace slamot::importers::scaled_cars
{
/// How the ego car moves: wheels and gyro, each row held until the next.
class Motion
{
 public:
  Motion(const std::string& folder, const ScaledCarsOptions& options);

  [[nodiscard]] double begin() const { return begin_; }
  [[nodiscard]] double end() const { return end_; }
  /// Whether the gyro's bias is known: given, or the car rested at the start for 0.5 s.
  [[nodiscard]] bool biasKnown() const { return biasKnown_; }

  /// The motion of the robot's frame between two times; calls come in rising order of time.
  Gaussian<Pose2D> between(double from, double to);

 private:
  void estimateBias();
  [[nodiscard]] Gaussian<Pose2D> held(double dt) const;

  const ScaledCarsOptions* options_;
  std::vector<WheelSpeeds> wheels_;
  std::vector<TurnRate> rates_;
  std::size_t wheel_ = 0, rate_ = 0;
  double begin_ = 0, end_ = 0, bias_ = 0;
  bool biasKnown_ = true;
};
}  // namespace slamot::importers::scaled_cars
