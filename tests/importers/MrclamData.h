#pragma once

#include <slamot/importers/Mrclam.h>

#include <cstdio>

#include "../results/TemporaryFolder.h"

namespace slamot::test
{
/// A dataset of two robots and two landmarks, 2 s long.  Robot 1 drives a circle to the left, then
/// straight on; its true path, at 10 Hz, is another one.
inline void writeMrclam(const TemporaryFolder& folder)
{
  folder.write("Barcodes.dat", "# Subject #\tBarcode #\n1 5\n2 14\n6 63\n7 81\n");
  folder.write("Landmark_Groundtruth.dat",
               "# Subject x y std std\n 6 1.5 2.5 0.001 0.001\n 7 -1 0 0.001 0.001\n");
  folder.write("Robot1_Odometry.dat",
               "# Time [s]  v  w\n1000.000 0.5 1.0\n1000.010 0.5 1.0\n1001.000\t0.2 0\n1002 9 9\n");
  folder.write("Robot1_Measurement.dat",
               "# Time barcode range bearing\n999.9 63 1 0\n1000.250 63 2.0 0.1\n"
               "1000.250 14 3.0 -0.2\n1000.250 99 1 0\n1000.250 5 1 0\n1001.5 81 1.0 0.05\n"
               "1001.5 63 -0.1 0\n1003 63 1 0\n");
  std::string path = "# t x y theta\n";
  for (int i = 0; i <= 30; ++i)
  {
    if (i > 10 && i < 17) continue;  // 0.7 s without truth
    char row[64];
    std::snprintf(row, sizeof row, "%.3f %.2f 2 %.2f\n", 999.5 + 0.1 * i, 0.1 * i, 3.1 + 0.01 * i);
    path += row;
  }
  folder.write("Robot1_Groundtruth.dat", path);
  folder.write("Robot2_Groundtruth.dat", "1000.1 0 0 0\n1000.4 3 0 0\n");
}

/// The same for five robots that drive and see alike, the first thing robot 3, and none sees
/// itself.
inline void writeMrclamTeam(const TemporaryFolder& folder)
{
  writeMrclam(folder);
  folder.write("Barcodes.dat", "1 5\n2 14\n3 41\n4 23\n5 18\n6 63\n7 81\n");
  const std::string odometry = folder.read("Robot1_Odometry.dat"),
                    seen = folder.read("Robot1_Measurement.dat"),
                    truth = folder.read("Robot1_Groundtruth.dat");
  for (int robot = 1; robot <= 5; ++robot)
  {
    const std::string name = "Robot" + std::to_string(robot);
    folder.write(name + "_Odometry.dat", odometry);
    folder.write(name + "_Measurement.dat",
                 "1000.1 41 1.5 0.3\n" + seen.substr(seen.find("1000.250")));
    folder.write(name + "_Groundtruth.dat", truth);
  }
}
}  // namespace slamot::test
