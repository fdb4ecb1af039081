#pragma once

#include <cmath>
#include <cstdio>

#include "VictoriaParkData.h"

namespace slamot::test
{
inline std::string csvRow(const std::vector<double>& values)
{
  std::string row;
  char text[40];
  for (const double v : values)
  {
    std::snprintf(text, sizeof text, row.empty() ? "%.15g" : ",%.15g", v);
    row += text;
  }
  return row + "\n";
}

/// A scan of 360 beams that all read the same [m].
inline std::string carScan(double time, double range)
{
  std::vector<double> row(362, range);
  row[0] = time, row[1] = time + 0.08;
  return csvRow(row);
}

inline std::string carScanHeader()
{
  std::string header = "t_stamp,t_recorded";
  for (int i = 0; i < 360; ++i) header += ",r" + std::to_string(i);
  return header + "\n";
}

inline const std::string kWheelsHeader = "t,FL,FR,BL,BR\n";
inline const std::string kImuHeader = "t,roll,pitch,yaw,wx,wy,wz,ax,ay,az\n";
inline const std::string kPoseHeader = "t,x,y,z,roll,pitch,yaw\n";

/// What the made-up car does: the middle of its rear axle rests for 1 s at (1, 2), drives straight
/// on along y at 1 m/s for 1 s, then to the left at 1 rad/s for 1 s.  Time counts from 10 s.
struct MadeUpCar
{
  static constexpr double kBias = 0.01, kHeadingOff = 0.05;  // [rad/s, rad], of gyro and truth
  static constexpr double kRadius = 0.0312, kWheelbase = 0.25, kTrack = 0.15, kAhead = 0.12;

  /// Pose of the point ahead of the axle, as it truly is; heading along the car.
  static std::vector<double> pose(double t)
  {
    const double straight = std::min(std::max(t - 11, 0.0), 1.0), turn = std::max(t - 12, 0.0);
    const double theta = std::acos(0.0) + turn;
    const double x = 1 - (1 - std::cos(turn)), y = 2 + straight + std::sin(turn);
    return {x + kAhead * std::cos(theta), y + kAhead * std::sin(theta), theta};
  }
};

/// One run of the made-up car, 3 s at 100 Hz, with a target that drives along x at 0.5 m/s, sliding
/// by 0.1 rad of its logged heading.  Scans at 9.95 (before odometry), then each 0.25 s, and 13.1
/// s.
inline void writeCars(const TemporaryFolder& folder)
{
  using C = MadeUpCar;
  std::string wheels = kWheelsHeader, imu = kImuHeader, ego = kPoseHeader, target = kPoseHeader;
  for (int i = 0; i <= 300; ++i)
  {
    const double t = 10 + 0.01 * i, v = i < 100 ? 0 : 1, rate = i < 200 ? 0 : 1;
    const double front = std::hypot(v, C::kWheelbase * rate), side = 0.5 * C::kTrack * rate;
    wheels += csvRow({t, (front - side) / C::kRadius, (front + side) / C::kRadius, 9 * v, 9 * v});
    imu += csvRow({t, 0, 0, 0, 0, 0, rate + C::kBias, 0, 0, 9.8});
    const auto p = C::pose(t);
    ego += csvRow(
        {t, p[0], p[1], 0.1, 0, 0, std::remainder(p[2] + C::kHeadingOff, 4 * std::acos(0.0))});
    target += csvRow({t, 0.5 * (t - 10), 3, 0.1, 0, 0, -0.1});
  }
  folder.write("wheel_speeds.csv", wheels);
  folder.write("imu.csv", imu);
  folder.write("ego_pose.csv", ego);
  folder.write("target_pose.csv", target);
  std::string scans = carScanHeader() + carScan(9.95, 1);
  for (int i = 0; i <= 12; ++i) scans += carScan(10 + 0.25 * i, i == 12 ? 9 : 0.5 * i);
  folder.write("scan.csv", scans + carScan(13.1, 1));
}
}  // namespace slamot::test
