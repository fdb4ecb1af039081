#pragma once

#include "streams.h"

#include <slamot/sim/Scenario.h>

namespace slamot::sim
{
/// One measurement and what it was of.
struct Seen
{
  double range = 0, bearing = 0;  ///< [m, rad]
  int object = core::kNoId;       ///< none: clutter
};

/// The random numbers of one scan.
struct ScanKeys
{
  std::uint64_t seed = 0;
  Purpose sensing = Purpose::kLandmarkSensing, clutter = Purpose::kLandmarkClutter;
  std::uint64_t step = 0, observer = 0;
};

/// One scan from the robot's pose, by rising bearing: objects whose true place is in view are seen
/// with the sensor's chance and noise; clutter is uniform over range and bearing.  Noise may put a
/// measurement out of the field of view.
[[nodiscard]] std::vector<Seen> sense(const SensorSetup& sensor, const Pose2D& robot,
                                      const std::map<int, Point2D>& objects, const ScanKeys& keys);

/// Whether readers keep it: range above zero and inside the scan's field of view.
[[nodiscard]] bool usable(const SensorSetup& sensor, const core::FieldOfView& fov,
                          const Seen& seen);

/// Of a scan for blobs: the hull of the views of all sensors for them.
[[nodiscard]] core::FieldOfView blobView(const Scenario& scenario);

/// As the sensor reports it.
[[nodiscard]] core::Sighting toSighting(const SensorSetup& sensor, const Seen& seen);
[[nodiscard]] core::Blob toBlob(const SensorSetup& sensor, const Seen& seen,
                                const std::string& label);
}  // namespace slamot::sim
