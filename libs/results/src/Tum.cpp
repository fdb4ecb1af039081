#include <slamot/results/TextFile.h>
#include <slamot/results/Tum.h>

#include <array>
#include <cmath>

namespace slamot::results
{
namespace
{
constexpr std::array<const char*, 8> kFields = {"timestamp", "x", "y", "z", "qx", "qy", "qz", "qw"};

// Writers round, some to three digits; beyond that it is no unit quaternion.
constexpr double kNormTolerance = 0.01;

void readHeading(const LineReader& line, const std::array<double, 8>& v, eval::TimedPose& pose)
{
  const double qx = v[4], qy = v[5], qz = v[6], qw = v[7];
  const double norm2 = qx * qx + qy * qy + qz * qz + qw * qw;
  pose.headingKnown = norm2 != 0;
  if (!pose.headingKnown) return;
  if (!(std::abs(std::sqrt(norm2) - 1) < kNormTolerance))
    line.fail("the quaternion is not of length 1", "mend the line, or write 0 0 0 0 for unknown");
  pose.pose.phi = std::atan2(2 * (qw * qz + qx * qy), norm2 - 2 * (qy * qy + qz * qz));
}

eval::TimedPose readRow(const LineReader& line)
{
  const auto parts = line.blankSeparated();
  if (parts.size() != kFields.size())
    line.fail("has " + std::to_string(parts.size()) + " fields, not 8",
              "write timestamp x y z qx qy qz qw");
  std::array<double, 8> v{};
  for (std::size_t i = 0; i < v.size(); ++i) v[i] = line.number(parts[i], kFields[i]);
  eval::TimedPose out;
  out.time = v[0];
  out.pose = {v[1], v[2], 0};
  readHeading(line, v, out);
  return out;
}
}  // namespace

eval::Trajectory loadTum(const std::string& path)
{
  eval::Trajectory out;
  for (LineReader line(path); line.next();)
  {
    const auto first = line.text().find_first_not_of(" \t");
    if (first == std::string_view::npos || line.text()[first] == '#') continue;
    const eval::TimedPose row = readRow(line);
    if (!out.empty() && row.time <= out.poses.back().time)
      line.fail("the time is not after the line's before", "sort by time, one line each");
    out.poses.push_back(row);
  }
  return out;
}

void saveTum(const std::string& path, const eval::Trajectory& trajectory)
{
  std::string text, previous;
  double previousTime = 0;
  for (const eval::TimedPose& row : trajectory.poses)
  {
    const Pose2D& p = row.pose;
    std::string time;
    appendFixed(time, row.time, 9);
    if (!std::isfinite(row.time + p.x + p.y + p.phi))
      throw core::Error(core::ExitStatus::kInternal, path, "a pose is not finite");
    if (!previous.empty() && (row.time <= previousTime || time == previous))
      throw core::Error(core::ExitStatus::kInternal, path, "times do not rise at " + time);
    text += time;
    const double known = row.headingKnown ? 1 : 0;
    for (const double v :
         {p.x, p.y, 0.0, 0.0, 0.0, known * std::sin(p.phi / 2), known * std::cos(p.phi / 2)})
    {
      text += ' ';
      appendFixed(text, v, 9);
    }
    text += '\n';
    previous = std::move(time);
    previousTime = row.time;
  }
  writeWhole(path, text);
}
}  // namespace slamot::results
