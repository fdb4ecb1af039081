#include "laserMaps.h"

#include <slamot/mrpt/LaserMaps.h>

#include <filesystem>

namespace slamot::apps
{
void saveLaserMaps(const std::string& folder, const eval::Record& record)
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
  if (scans.empty()) return;
  const std::filesystem::path place(folder);
  mrpt::saveSimpleMap((place / "map.simplemap").string(), scans);
  mrpt::savePoints((place / "points.txt").string(), scans);
  mrpt::saveGrid((place / "grid.png").string(), (place / "map.gridmap").string(), scans);
}
}  // namespace slamot::apps
