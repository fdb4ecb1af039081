#pragma once

#include <zlib.h>

#include <cstdio>

#include "../results/TemporaryFolder.h"

namespace slamot::test
{
inline std::string parkRow(const std::vector<double>& values)
{
  std::string row;
  char text[40];
  for (const double v : values)
  {
    std::snprintf(text, sizeof text, row.empty() ? "%.9g" : " %.9g", v);
    row += text;
  }
  return row + "\n";
}

/// A scan all of whose beams read the same [cm].
inline std::string parkLaserRow(double time, int reading)
{
  std::vector<double> row(362, reading);
  row[0] = time;
  return parkRow(row);
}

/// A drive of 2 s from t = 1 s at 40 Hz: 1 s straight on at 2 m/s, then 1 s steered to the left by
/// 0.3 rad.  Scans at 0.8 (before the first row), 1.5, 2, 2.5 and 3.2 s (after the last); at 2 s
/// no tree is seen.
inline void writePark(const TemporaryFolder& folder)
{
  std::string inputs = "# time speed steering\n";
  for (int i = 0; i <= 80; ++i) inputs += parkRow({1 + 0.025 * i, 2.0, i < 40 ? 0.0 : 0.3});
  folder.write("inputs.txt", inputs);
  folder.write("trees.txt",
               "# time range bearing diameter\n0.8 5 1 0.2\n1.5 10 1.5707963267948966 0.3\n"
               "1.5 20 2.5 0.4\n2.5 30 0.5 0.2\n2.5 -0.1 1.5 0.2\n2.5 79 0.01 0.2\n3.2 8 1 0.2\n");
  std::string laser = "# time 361 ranges\n";
  for (const double time : {0.8, 1.5, 2.0, 2.5, 3.2}) laser += parkLaserRow(time, 1234);
  folder.write("laser_cm.txt", laser);
  folder.write("gps_first_600s.txt", "# time east north\n0.5 10 20\n1.2 11 20.5\n2.9 13.5 21\n");
}

/// Packs a file as <name>.gz in its place.
inline void packGz(const TemporaryFolder& folder, const std::string& name)
{
  const std::string text = folder.read(name);
  gzFile file = gzopen(folder.file(name + ".gz").c_str(), "wb");
  gzwrite(file, text.data(), static_cast<unsigned>(text.size()));
  gzclose(file);
  std::filesystem::remove(folder.file(name));
}
}  // namespace slamot::test
