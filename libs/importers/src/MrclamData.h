#pragma once

#include <slamot/core/Step.h>
#include <slamot/eval/Truth.h>
#include <slamot/importers/Mrclam.h>

#include <map>
#include <string>
#include <vector>

/// An MRCLAM dataset's tables, as one robot needs them.
namespace slamot::importers::mrclam
{
inline constexpr int kRobots = kMrclamRobots;  ///< subjects above are landmarks

struct Velocity
{
  double time = 0, v = 0, omega = 0;  ///< [s, m/s, rad/s]
};
struct Measurement
{
  double time = 0;
  int barcode = 0;
  double range = 0, bearing = 0;  ///< [m, rad]
};

/// Subjects by barcode.
std::map<int, int> readBarcodes(const std::string& folder);
/// At least one row, in rising order of time.
std::vector<Velocity> readOdometry(const std::string& folder, int robot);
std::vector<Measurement> readMeasurements(const std::string& folder, int robot);
/// The hull of what was measured, to the next centimetre and hundredth of a radian.
core::FieldOfView hullOf(const std::vector<Measurement>& all);
/// Empty if the dataset has none.
eval::Trajectory readTruePath(const std::string& folder, int robot);
std::map<int, Point2D> readTrueLandmarks(const std::string& folder);
}  // namespace slamot::importers::mrclam
