#pragma once

#include <slamot/perception/LandmarkDetector.h>
#include <slamot/perception/fitCircle.h>

namespace slamot::perception
{
/// What round things are to look like.
struct RoundOptions
{
  Roundness roundness;    ///< of the radius, before it is seen
  double least = 0.02;    ///< radius of what is kept [m]
  double most = 0.3;      ///< radius of what is kept [m]
  int leastPoints = 3;    ///< returns on it
  double maxRange = 20;   ///< [m]
  double mostMisfit = 4;  ///< see CircleFit::misfit

  static RoundOptions posts();  ///< of 0.1 m, all alike
  static RoundOptions trees();  ///< 0.02 to 0.8 m, not known before

  /// Keys radius_m, radius_std_m, min_radius_m, max_radius_m, min_points, max_range_m, max_misfit.
  static RoundOptions from(core::Params& p, const RoundOptions& defaults);
};

/// Posts and trees: clusters that stand free on both sides and are round.
class RoundDetector : public LandmarkDetector
{
 public:
  /// `laser` tells how far returns err.
  RoundDetector(const RoundOptions& options, const LaserOptions& laser)
      : options_(options), laser_(laser)
  {
  }
  [[nodiscard]] std::vector<DetectedLandmark> detect(
      const core::LaserScan& scan, const std::vector<Cluster>& clusters) const override;
  [[nodiscard]] double maxRange() const override { return options_.maxRange; }

 private:
  [[nodiscard]] bool mayBe(const Cluster& cluster) const;

  RoundOptions options_;
  LaserOptions laser_;
};
}  // namespace slamot::perception
