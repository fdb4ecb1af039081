#pragma once

#include <cstdio>

#include "VictoriaParkData.h"

namespace slamot::test
{
inline std::string carmenText(const std::vector<double>& values)
{
  std::string out;
  char text[40];
  for (const double v : values)
  {
    std::snprintf(text, sizeof text, " %.15g", v);
    out += text;
  }
  return out;
}

/// A message FLASER or RLASER; the laser's own pose is one that nobody is to take for odometry.
inline std::string oldScan(const std::string& kind, const std::vector<double>& ranges,
                           const std::vector<double>& odometry, double time)
{
  return kind + carmenText({static_cast<double>(ranges.size())}) + carmenText(ranges) + " 90 91 3" +
         carmenText(odometry) + carmenText({time}) + " host 0.5\n";
}

inline std::string odometryLine(const std::vector<double>& pose, double time)
{
  return "ODOM" + carmenText(pose) + " 0.1 0.2 0" + carmenText({time}) + " host 0.5\n";
}

/// A message ROBOTLASER1 or ROBOTLASER2 of three beams from -0.5 rad on in steps of 0.25.
/// \param remissions none: as older loggers write.
inline std::string newScan(const std::string& kind, const std::string& remissions,
                           const std::vector<double>& laser, const std::vector<double>& robot,
                           double time)
{
  return kind + " 0 -0.5 0.5 0.25 20 0.01 0 3 1 2 19.9" + remissions + carmenText(laser) +
         carmenText(robot) + " 0.4 0.1 0.3 0.3" + (remissions.empty() ? "" : " 1e5") +
         carmenText({time}) + " host 0.5\n";
}

/// Three scans: 2 m along y, then a turn on the spot by 0.5 rad.
inline std::string carmenLog()
{
  return "# message_name [message contents] ipc_timestamp ipc_hostname logger_timestamp\n"
         "PARAM robot_width 0.5 0 host 0\n" +
         odometryLine({5, 6, 1.5}, 99.9) + oldScan("FLASER", {1, 2, 3}, {5, 6, 1.5}, 100) + "\n" +
         oldScan("FLASER", {1.5, 80, 81.83}, {5, 8, 1.5}, 101.25) + "NMEAGGA 1 2 3 101 host 0\n" +
         oldScan("FLASER", {0, -1, 4}, {5, 8, 2}, 102.5);
}

/// One from 100 to 101.25 s that a path without errors has, one back, and one of other times.
inline std::string carmenRelations()
{
  return "# t1 t2 dx dy dz droll dpitch dyaw\n"
         "100 101.25 1.994989973 0.141474403 0 0 0 0\n"
         "102.5 101.25 0 0 0 0 0 -0.5\n100 107 1 1 0 0 0 0\n";
}
}  // namespace slamot::test
