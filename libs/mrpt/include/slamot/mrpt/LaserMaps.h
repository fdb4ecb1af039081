#pragma once

#include <slamot/core/Step.h>

#include <memory>
#include <string>
#include <vector>

namespace slamot::mrpt
{
/// Laser scans of one instant and the robot's pose then.
struct PosedScans
{
  double time = 0;         ///< [s]
  Gaussian<Pose2D> robot;  ///< in map axes
  std::vector<std::shared_ptr<const core::LaserScan>>
      scans;  ///< of all lasers at that instant; never null
};

/// Writes the scans and their poses as MRPT's simple map, from which its tools make maps of any
/// kind (observations2map, pf-localization).  The same data gives the same bytes.
/// \throws core::Error (kUnreadable) if the file can't be written.
void saveSimpleMap(const std::string& path, const std::vector<PosedScans>& scans);

/// Their returns as points in map axes, `x y` lines [m] that MRPT's CSimplePointsMap and others
/// load. \throws as above.
void savePoints(const std::string& path, const std::vector<PosedScans>& scans);

/// Reads the scans of such a file back, each with its time; poses are left out.  What is damaged
/// or malicious costs no more than its size.
/// \throws core::Error (kUnreadable, kTruncated, kNonsense, kLimit).
[[nodiscard]] std::vector<PosedScans> loadScans(const std::string& path);

/// Draws them as an occupancy grid, dark where something stands: 0.05 m a pixel, coarser where that
/// would make more than four million; and saves the grid itself (`gridPath`, MRPT's gz .gridmap,
/// which its tools load).  \throws as above.
void saveGrid(const std::string& picturePath, const std::string& gridPath,
              const std::vector<PosedScans>& scans);
}  // namespace slamot::mrpt
