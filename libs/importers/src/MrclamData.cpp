#include "MrclamData.h"

#include <slamot/importers/TextTable.h>

#include <algorithm>
#include <cmath>

namespace slamot::importers::mrclam
{
namespace
{
using core::ExitStatus;

std::string pathOf(const std::string& folder, const std::string& name)
{
  return plainOrGz(folder + "/" + name);
}

std::string required(const std::string& folder, const std::string& name)
{
  const std::string path = pathOf(folder, name);
  if (path.empty())
    throw core::Error(ExitStatus::kUnreadable, folder + "/" + name,
                      "neither this nor its .gz is there", "give the folder of one MRCLAM dataset");
  return path;
}

std::string ofRobot(int robot, const char* what)
{
  return "Robot" + std::to_string(robot) + "_" + what + ".dat";
}

/// The time in column 0, not before the last row's.
double nextTime(const TextTable& table, double last)
{
  const double time = table.number(0);
  if (time < last)
    table.failAt(0, ExitStatus::kNonsense, "the time goes backwards", "sort the rows by time");
  return time;
}
}  // namespace

std::map<int, int> readBarcodes(const std::string& folder)
{
  auto table = TextTable::blanks(required(folder, "Barcodes.dat"), {"subject", "barcode"});
  std::map<int, int> out;
  while (table.next())
    if (!out.emplace(table.integer(1, 0), table.integer(0, 1)).second)
      table.failAt(1, ExitStatus::kNonsense, "the barcode comes twice", "remove one row");
  return out;
}

std::vector<Velocity> readOdometry(const std::string& folder, int robot)
{
  auto table =
      TextTable::blanks(required(folder, ofRobot(robot, "Odometry")), {"time", "v", "omega"});
  std::vector<Velocity> out;
  while (table.next())
    out.push_back(
        {nextTime(table, out.empty() ? 0 : out.back().time), table.number(1), table.number(2)});
  if (out.empty()) table.fail(ExitStatus::kUnreadable, "holds no rows", "copy it again");
  return out;
}

std::vector<Measurement> readMeasurements(const std::string& folder, int robot)
{
  auto table = TextTable::blanks(required(folder, ofRobot(robot, "Measurement")),
                                 {"time", "barcode", "range", "bearing"});
  std::vector<Measurement> out;
  while (table.next())
    out.push_back({nextTime(table, out.empty() ? 0 : out.back().time), table.integer(1, 0),
                   table.number(2), math::wrapToPi(table.number(3))});
  return out;
}

core::FieldOfView hullOf(const std::vector<Measurement>& all)
{
  core::FieldOfView fov{1e6, 0, math::kPi, -math::kPi};
  for (const Measurement& m : all)
  {
    if (m.range <= 0) continue;
    fov.rangeMin = std::min(fov.rangeMin, std::floor(100 * m.range) / 100);
    fov.rangeMax = std::max(fov.rangeMax, std::ceil(100 * m.range) / 100);
    fov.bearingMin = std::min(fov.bearingMin, std::floor(100 * m.bearing) / 100);
    fov.bearingMax = std::max(fov.bearingMax, std::ceil(100 * m.bearing) / 100);
  }
  if (fov.rangeMax == 0) return {};
  fov.bearingMin = std::max(fov.bearingMin, -math::kPi);
  fov.bearingMax = std::min(fov.bearingMax, math::kPi);
  return fov;
}

eval::Trajectory readTruePath(const std::string& folder, int robot)
{
  eval::Trajectory out;
  const std::string path = pathOf(folder, ofRobot(robot, "Groundtruth"));
  if (path.empty()) return out;
  auto table = TextTable::blanks(path, {"time", "x", "y", "theta"});
  while (table.next())
  {
    const double time = nextTime(table, out.empty() ? 0 : out.poses.back().time);
    if (!out.empty() && time == out.poses.back().time) continue;
    out.poses.push_back(
        {time, {table.number(1), table.number(2), math::wrapToPi(table.number(3))}, true});
  }
  return out;
}

std::map<int, Point2D> readTrueLandmarks(const std::string& folder)
{
  std::map<int, Point2D> out;
  const std::string path = pathOf(folder, "Landmark_Groundtruth.dat");
  if (path.empty()) return out;
  auto table = TextTable::blanks(path, {"subject", "x", "y", "x_std", "y_std"});
  while (table.next()) out[table.integer(0, 1)] = {table.number(1), table.number(2)};
  return out;
}
}  // namespace slamot::importers::mrclam
