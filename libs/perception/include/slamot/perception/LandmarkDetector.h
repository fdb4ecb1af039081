#pragma once

/// \file
/// Landmark detectors, their registry, and SLAMOT_REGISTER_LANDMARK_DETECTOR for plugins.

#include <slamot/core/Config.h>
#include <slamot/math/gaussian.h>
#include <slamot/perception/LaserClusters.h>

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace slamot::perception
{
/// A thing that stays where it is, found in a scan.
struct DetectedLandmark
{
  Gaussian<Point2D> at;  ///< in the robot's frame, covariance along its axes [m²]
  double size = 0;       ///< radius of what is round; 0: has none [m]
};

/// Finds one kind of landmark in a scan.  An open set: derive, register, and name it in [detect].
class LandmarkDetector
{
 public:
  virtual ~LandmarkDetector() = default;
  /// \param clusters those of the scan, without what is known to move.
  [[nodiscard]] virtual std::vector<DetectedLandmark> detect(
      const core::LaserScan& scan, const std::vector<Cluster>& clusters) const = 0;
  /// Farther ones are not looked for [m].
  [[nodiscard]] virtual double maxRange() const = 0;
};

/// The kinds that can be made by name: posts, trees, corners, and those of plugins.
class LandmarkDetectorRegistry
{
 public:
  /// Makes a detector from its section of the config.
  using Factory =
      std::function<std::unique_ptr<LandmarkDetector>(core::Params&, const LaserOptions&)>;

  /// The one of this process, for the program and every plugin that it loads.
  static LandmarkDetectorRegistry& instance();
  /// As for filters, a name that comes twice is an error of make().
  void add(const std::string& name, Factory factory);
  /// In alphabetical order.
  [[nodiscard]] std::vector<std::string> names() const;
  /// With the config's section of that name.  \throws core::Error (kConfig).
  [[nodiscard]] std::unique_ptr<LandmarkDetector> make(const std::string& name,
                                                       core::Config& config,
                                                       const LaserOptions& laser) const;

 private:
  LandmarkDetectorRegistry();
  std::map<std::string, Factory> factories_;
  std::set<std::string> twice_;
};
}  // namespace slamot::perception

/// In a plugin's .cpp, at global scope: `class` is made by (core::Params&, const LaserOptions&).
#define SLAMOT_REGISTER_LANDMARK_DETECTOR(name, class)                                   \
  namespace                                                                              \
  {                                                                                      \
  const bool slamotDetectorRegistered = []                                               \
  {                                                                                      \
    ::slamot::perception::LandmarkDetectorRegistry::instance().add(                      \
        name, [](::slamot::core::Params& p, const ::slamot::perception::LaserOptions& o) \
        { return std::make_unique<class>(p, o); });                                      \
    return true;                                                                         \
  }();                                                                                   \
  }
