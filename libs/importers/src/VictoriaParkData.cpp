#include "VictoriaParkData.h"

#include <algorithm>

namespace slamot::importers::victoria_park
{
namespace
{
using core::ExitStatus;

constexpr double kLongestHold = 1;  // [s]; rows come at 40 Hz
constexpr double kFastest = 50;     // [m/s]
constexpr double kSharpest = 1;     // [rad]; where tan(steering) = L / H a wheel stands still
constexpr double kLaserReach = 80;  // [m]; what the data's own README calls a return
constexpr double kOwnBody = 1;      // [m]; the 12 beams to the right hit the car itself

std::string required(const std::string& folder, const std::string& name)
{
  std::string path = plainOrGz(folder + "/" + name);
  if (path.empty())
    throw core::Error(ExitStatus::kUnreadable, folder + "/" + name,
                      "neither this nor its .gz is there", "give the folder of Victoria Park");
  return path;
}

[[noreturn]] void failEmpty(const TextTable& table)
{
  table.fail(ExitStatus::kUnreadable, "holds no rows", "copy it again");
}

/// The time in column 0, not before the last row's.
double nextTime(const TextTable& table, double last)
{
  const double time = table.number(0);
  if (time < last)
    table.failAt(0, ExitStatus::kNonsense, "the time goes backwards", "sort the rows by time");
  return time;
}

TextTable::Names laserColumns()
{
  TextTable::Names names = {"time"};
  for (int i = 0; i < kBeams; ++i) names.push_back("r" + std::to_string(i));
  return names;
}
}  // namespace

Inputs::Inputs(const std::string& folder, const VictoriaParkOptions& options)
    : options_(&options),
      table_(TextTable::blanks(required(folder, "inputs.txt"), {"time", "speed", "steering"}))
{
  row_ = read();
  if (!row_) failEmpty(table_);
  begin_ = time_ = row_->time;
  next_ = read();
}

std::optional<Inputs::Row> Inputs::read()
{
  if (!table_.next()) return std::nullopt;
  Row row;
  row.time = row_ ? nextTime(table_, row_->time) : table_.number(0);
  if (row_ && row.time - row_->time > kLongestHold)
    table_.failAt(0, ExitStatus::kNonsense,
                  "there is no row for over 1 s, and the motion meanwhile is not known",
                  "cut the data there");
  row.speed = table_.number(1);
  if (std::abs(row.speed) > kFastest)
    table_.failAt(1, ExitStatus::kNonsense, "no car goes as fast", "write metres per second");
  row.steering = table_.number(2) * options_->steeringScale + options_->steeringOffset;
  if (!(std::abs(row.steering) < kSharpest))
    table_.failAt(2, ExitStatus::kNonsense, "no car steers as sharply", "write radians below 1");
  return row;
}

Inputs::Motion Inputs::until(double time)
{
  Gaussian<Pose2D> axle;
  while (next_ && time_ < time)
  {
    const double end = std::min(time, next_->time);
    if (end > time_)
      axle = math::compose(
          axle, carArc(options_->car, options_->noise, row_->speed, row_->steering, end - time_));
    time_ = std::max(time_, end);
    if (time_ < next_->time) break;
    row_ = next_;
    next_ = read();
  }
  return {time_, carriedTo(options_->car.mount, axle)};
}

ScanTable::ScanTable(TextTable table, double delay) : table_(std::move(table)), delay_(delay)
{
  if (!table_.next()) failEmpty(table_);
  logged_ = table_.number(0);
  time_ = logged_ - delay_;
}

void ScanTable::advance()
{
  time_.reset();
  if (!table_.next()) return;
  logged_ = nextTime(table_, logged_);
  time_ = logged_ - delay_;
}

Trees::Trees(const std::string& folder, const VictoriaParkOptions& options)
    : table_(TextTable::blanks(required(folder, "trees.txt"),
                               {"time", "range", "bearing", "diameter"}),
             options.laserDelay)
{
}

std::vector<Trees::Tree> Trees::take()
{
  std::vector<Tree> out;
  const TextTable& row = table_.row();
  for (const auto time = table_.time(); table_.time() && table_.time() == time; table_.advance())
  {
    (void)row.nonNegative(3);
    out.push_back({row.number(1), math::wrapToPi(row.number(2) - math::kPi / 2)});
    if (out.size() > kBeams)
      row.fail(ExitStatus::kNonsense, "more trees at one time than the laser has beams",
               "mend the times");
  }
  return out;
}

Lasers::Lasers(const std::string& folder, const VictoriaParkOptions& options)
    : yaw_(options.laserYaw)
{
  const std::string path =
      options.lasers ? required(folder, "laser_cm.txt") : plainOrGz(folder + "/laser_cm.txt");
  if (!path.empty()) table_.emplace(TextTable::blanks(path, laserColumns()), options.laserDelay);
}

std::shared_ptr<const core::LaserScan> Lasers::take()
{
  auto scan = std::make_shared<core::LaserScan>();
  scan->pose_robot_sensor.phi = yaw_;
  scan->angleMin = -math::kPi / 2;
  scan->angleStep = math::kPi / (kBeams - 1);
  scan->rangeMax = kLaserReach;
  scan->ranges.reserve(kBeams);
  for (std::size_t i = 1; i <= kBeams; ++i)
  {
    const double range = 0.01 * table_->row().integer(i, 0);
    const bool isReturn = range >= kOwnBody && range < kLaserReach;
    scan->ranges.push_back(static_cast<float>(isReturn ? range : 2 * kLaserReach));
  }
  table_->advance();
  return scan;
}

eval::Trajectory readFixes(const std::string& folder)
{
  eval::Trajectory out;
  const std::string path = plainOrGz(folder + "/gps_first_600s.txt");
  if (path.empty()) return out;
  auto table = TextTable::blanks(path, {"time", "east", "north"});
  while (table.next())
  {
    const double time = table.number(0);
    if (!out.empty() && time <= out.poses.back().time)
      table.failAt(0, ExitStatus::kNonsense, "the time does not rise", "sort the rows by time");
    out.poses.push_back({time, {table.number(1), table.number(2), 0}, false});
  }
  if (out.empty()) failEmpty(table);
  return out;
}
}  // namespace slamot::importers::victoria_park
