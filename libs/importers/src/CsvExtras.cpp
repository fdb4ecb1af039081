#include "CsvExtras.h"

#include "fileExists.h"

#include <slamot/importers/TextTable.h>

#include <charconv>
#include <filesystem>

namespace slamot::importers
{
namespace
{
namespace fs = std::filesystem;
using core::ExitStatus;

/// The number in `<prefix><number><suffix>`; none if the text is not of that form.
std::optional<int> numberIn(std::string_view s, std::string_view prefix, std::string_view suffix)
{
  if (s.size() <= prefix.size() + suffix.size() || s.substr(0, prefix.size()) != prefix ||
      s.substr(s.size() - suffix.size()) != suffix)
    return std::nullopt;
  s = s.substr(prefix.size(), s.size() - prefix.size() - suffix.size());
  int value = 0;
  const auto [end, error] = std::from_chars(s.data(), s.data() + s.size(), value);
  if (error != std::errc{} || end != s.data() + s.size() || value < 0) return std::nullopt;
  return value;
}

/// Limits of a bearing, in [-pi, pi]; text rounds pi up or down.
void limitBearings(const TextTable& table, core::FieldOfView& fov)
{
  constexpr double kRounding = 2e-3;  // [rad], 3.14 for pi
  const double width = fov.bearingMax - fov.bearingMin;
  if (std::abs(width - math::kTwoPi) <= 2 * kRounding && std::abs(fov.bearingMin) < math::kTwoPi)
  {
    fov.bearingMin = -math::kPi;
    fov.bearingMax = math::kPi;
  }
  if (fov.bearingMin < -math::kPi - kRounding || fov.bearingMax > math::kPi + kRounding)
    table.fail(ExitStatus::kNonsense, "bearings must lie between -pi and pi",
               "write them in radians from the robot's heading");
  fov.bearingMin = std::max(fov.bearingMin, -math::kPi);
  fov.bearingMax = std::min(fov.bearingMax, math::kPi);
}

core::ObjectStart startOf(const TextTable& table)
{
  core::ObjectStart out;
  for (std::size_t i = 0; i < out.value.size(); ++i)
  {
    out.value[i] = table.optionalNumber(1 + i);
    const std::size_t stdColumn = 1 + out.value.size() + i;
    if (!table.empty(stdColumn)) out.std[i] = table.nonNegative(stdColumn);
  }
  return out;
}

eval::Trajectory readTrajectory(const std::string& path)
{
  TextTable table = TextTable::csv(path);
  table.matchHeader({{"t", "x", "y", "theta"}});
  eval::Trajectory out;
  while (table.next())
  {
    const double t = table.number(0);
    if (!out.empty() && t <= out.poses.back().time)
      table.failAt(0, ExitStatus::kNonsense, "the time does not rise", "sort the rows by time");
    const auto theta = table.optionalNumber(3);
    out.poses.push_back({t,
                         {table.number(1), table.number(2), math::wrapToPi(theta.value_or(0))},
                         theta.has_value()});
  }
  return out;
}

std::map<int, Point2D> readLandmarks(const std::string& path)
{
  TextTable table = TextTable::csv(path);
  table.matchHeader({{"id", "x", "y"}});
  std::map<int, Point2D> out;
  while (table.next())
    if (!out.emplace(table.integer(0, 0), Point2D(table.number(1), table.number(2))).second)
      table.failAt(0, ExitStatus::kNonsense, "the id comes twice", "remove one row");
  return out;
}
}  // namespace

core::FieldOfView readFov(const std::string& folder)
{
  core::FieldOfView fov;
  const std::string path = folder + "/fov.csv";
  if (!fileExists(path)) return fov;
  TextTable table = TextTable::csv(path);
  table.matchHeader({{"range_min", "range_max", "bearing_min", "bearing_max"}});
  if (!table.next()) table.fail(ExitStatus::kUnreadable, "holds no row", "write one row");
  fov = {table.nonNegative(0), table.positive(1), table.number(2), table.number(3)};
  if (fov.rangeMax <= fov.rangeMin || fov.bearingMax <= fov.bearingMin)
    table.fail(ExitStatus::kNonsense, "a lower limit is not below its upper limit",
               "give the lower limit first");
  limitBearings(table, fov);
  if (table.next()) table.fail(ExitStatus::kUnreadable, "a second row", "write one row");
  return fov;
}

core::Starts readStarts(const std::string& folder)
{
  core::Starts starts;
  const std::string path = folder + "/start.csv";
  if (!fileExists(path)) return starts;
  TextTable table = TextTable::csv(path);
  table.matchHeader({{"object", "x", "y", "theta", "vx", "vy", "ax", "ay", "std_x", "std_y",
                      "std_theta", "std_vx", "std_vy", "std_ax", "std_ay"}});
  while (table.next())
  {
    const auto target = numberIn(table.text(0), "target_", "");
    if (!target && table.text(0) != "robot")
      table.failAt(0, ExitStatus::kUnreadable, quoted(table.text(0)) + " is no object",
                   "write robot or target_<id>");
    if (target ? starts.targets.count(*target) > 0 : starts.robot.has_value())
      table.failAt(0, ExitStatus::kNonsense, "the object comes twice", "remove one row");
    (target ? starts.targets[*target] : starts.robot.emplace()) = startOf(table);
  }
  return starts;
}

eval::Truth readTruth(const std::string& folder)
{
  eval::Truth truth;
  std::error_code error;
  const fs::directory_iterator entries(folder, error);
  if (error)
    throw core::Error(ExitStatus::kUnreadable, folder, "can't be listed: " + error.message(),
                      "check its rights");
  for (const auto& entry : entries)
  {
    const std::string path = entry.path().string(), name = entry.path().filename().string();
    if (name == "truth_robot.csv")
      truth.robot = readTrajectory(path);
    else if (name == "truth_landmarks.csv")
      truth.landmarks = readLandmarks(path);
    else if (const auto id = numberIn(name, "truth_target_", ".csv"))
      truth.targets[*id] = readTrajectory(path);
  }
  return truth;
}
}  // namespace slamot::importers
