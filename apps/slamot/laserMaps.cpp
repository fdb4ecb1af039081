#include "laserMaps.h"

#include <slamot/mrpt/LaserMaps.h>

#include <algorithm>
#include <filesystem>

namespace slamot::apps
{
namespace
{
namespace fs = std::filesystem;

void save(const fs::path& place, const std::vector<mrpt::PosedScans>& scans)
{
  if (scans.empty()) return;
  fs::create_directories(place);
  mrpt::saveSimpleMap((place / "map.simplemap").string(), scans);
  mrpt::savePoints((place / "points.txt").string(), scans);
  mrpt::saveGrid((place / "grid.png").string(), (place / "map.gridmap").string(), scans);
}

std::vector<mrpt::PosedScans> estimatedScans(const eval::Record& record)
{
  std::vector<mrpt::PosedScans> scans;
  std::size_t last = 0;
  for (const eval::LaserRow& laser : record.lasers)
  {
    const eval::RobotRow& row = record.rows[laser.row];
    if (scans.empty() || laser.row != last) scans.push_back({row.time, row.robot, {}});
    scans.back().scans.push_back(laser.scan);
    last = laser.row;
  }
  return scans;
}

/// How sure the path is of its poses is not told: no covariance.
std::vector<mrpt::PosedScans> onPath(const std::vector<mrpt::PosedScans>& scans,
                                     const eval::Trajectory& path)
{
  std::vector<mrpt::PosedScans> out;
  for (const mrpt::PosedScans& s : scans)
    if (const auto p = path.at(s.time))
      out.push_back({s.time, {p->pose, Matrix3::Zero()}, s.scans});
  return out;
}
}  // namespace

void saveLaserMaps(const std::string& folder, const eval::Record& record)
{
  const std::vector<mrpt::PosedScans> scans = estimatedScans(record);
  save(folder, scans);
  save(fs::path(folder) / "path", onPath(scans, record.path));
}

void loadLasers(const std::string& folder, eval::Record& record)
{
  constexpr double kSameTime = 1e-6;  // [s]: files hold tenths of microseconds
  const fs::path map = fs::path(folder) / "map.simplemap";
  if (!fs::exists(map)) return;
  for (const mrpt::PosedScans& s : mrpt::loadScans(map.string()))
  {
    const auto at = std::lower_bound(record.rows.begin(), record.rows.end(), s.time - kSameTime,
                                     [](const auto& row, double t) { return row.time < t; });
    if (at == record.rows.end() || at->time > s.time + kSameTime) continue;
    const auto row = static_cast<std::size_t>(at - record.rows.begin());
    for (const auto& scan : s.scans) record.lasers.push_back({row, scan});
  }
}
}  // namespace slamot::apps
