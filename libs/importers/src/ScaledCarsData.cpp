#include "ScaledCarsData.h"

namespace slamot::importers::scaled_cars
{
namespace
{
using core::ExitStatus;

constexpr double kLongestHold = 1;      // [s]; rows come at 36 and 85 Hz
constexpr double kFastestWheel = 1000;  // [rad/s], 30 m/s
constexpr double kFastestTurn = 100;    // [rad/s]
constexpr int kMostTargets = 9;

TextTable open(const std::string& path, const TextTable::Names& header)
{
  TextTable table = TextTable::csv(path);
  table.matchHeader({header});
  return table;
}

TextTable openRequired(const std::string& folder, const std::string& name,
                       const TextTable::Names& header)
{
  const std::string path = plainOrGz(folder + "/" + name);
  if (path.empty())
    throw core::Error(ExitStatus::kUnreadable, folder + "/" + name,
                      "neither this nor its .gz is there",
                      "give the folder of one run of the scaled cars");
  return open(path, header);
}

/// The time in column 0, not before the last row's; the first row has none before it.
double nextTime(const TextTable& table, std::optional<double> last)
{
  const double time = table.number(0);
  if (last && time < *last)
    table.failAt(0, ExitStatus::kNonsense, "the time goes backwards", "sort the rows by time");
  return time;
}

/// The time of odometry's next row.
double nextHeld(const TextTable& table, std::optional<double> last)
{
  const double time = nextTime(table, last);
  if (last && time - *last > kLongestHold)
    table.failAt(0, ExitStatus::kNonsense,
                 "there is no row for over 1 s, and the motion meanwhile is not known",
                 "cut the data there");
  return time;
}

double limited(const TextTable& table, std::size_t column, double limit)
{
  const double value = table.number(column);
  if (std::abs(value) > limit)
    table.failAt(column, ExitStatus::kNonsense, "no car turns as fast", "write radians per second");
  return value;
}

template <class Row>
std::optional<double> lastTime(const std::vector<Row>& rows)
{
  if (rows.empty()) return std::nullopt;
  return rows.back().time;
}

template <class Row>
std::vector<Row> checked(const TextTable& table, std::vector<Row> rows)
{
  if (rows.empty()) table.fail(ExitStatus::kUnreadable, "holds no rows", "copy it again");
  return rows;
}

TextTable::Names scanColumns()
{
  TextTable::Names names = {"t_stamp", "t_recorded"};
  for (int i = 0; i < kBeams; ++i) names.push_back("r" + std::to_string(i));
  return names;
}
}  // namespace

std::vector<WheelSpeeds> readWheels(const std::string& folder)
{
  auto table = openRequired(folder, "wheel_speeds.csv", {"t", "FL", "FR", "BL", "BR"});
  std::vector<WheelSpeeds> out;
  while (table.next())
  {
    WheelSpeeds row;
    row.time = nextHeld(table, lastTime(out));
    for (std::size_t i = 0; i < 4; ++i) row.speed[i] = limited(table, i + 1, kFastestWheel);
    out.push_back(row);
  }
  return checked(table, std::move(out));
}

std::vector<TurnRate> readTurnRates(const std::string& folder)
{
  constexpr std::size_t kRate = 6;
  auto table = openRequired(folder, "imu.csv",
                            {"t", "roll", "pitch", "yaw", "wx", "wy", "wz", "ax", "ay", "az"});
  std::vector<TurnRate> out;
  while (table.next())
    out.push_back({nextHeld(table, lastTime(out)), limited(table, kRate, kFastestTurn)});
  return checked(table, std::move(out));
}

eval::Trajectory readPoses(const std::string& folder, const std::string& name)
{
  eval::Trajectory out;
  const std::string path = plainOrGz(folder + "/" + name + "_pose.csv");
  if (path.empty()) return out;
  auto table = open(path, {"t", "x", "y", "z", "roll", "pitch", "yaw"});
  while (table.next())
  {
    const double time = nextTime(table, lastTime(out.poses));
    if (!out.empty() && time == out.poses.back().time) continue;
    out.poses.push_back(
        {time, {table.number(1), table.number(2), math::wrapToPi(table.number(6))}, true});
  }
  return out;
}

std::map<int, eval::Trajectory> readTargets(const std::string& folder)
{
  std::map<int, eval::Trajectory> out;
  if (auto path = readPoses(folder, "target"); !path.empty()) out[1] = std::move(path);
  for (int id = 1; id <= kMostTargets; ++id)
    if (auto path = readPoses(folder, "target" + std::to_string(id)); !path.empty())
      out[id] = std::move(path);
  return out;
}

LaserScans::LaserScans(const std::string& folder, const ScaledCarsOptions& options)
    : options_(&options), table_(openRequired(folder, "scan.csv", scanColumns()))
{
  advance();
  if (!time_) table_.fail(ExitStatus::kUnreadable, "holds no rows", "copy it again");
}

void LaserScans::advance()
{
  time_.reset();
  if (!table_.next()) return;
  const auto last = logged_;
  logged_ = nextTime(table_, last);
  if (logged_ == last)
    table_.failAt(0, ExitStatus::kNonsense, "two scans are of one time", "remove one row");
  time_ = *logged_ - options_->laserDelay;
}

std::shared_ptr<const core::LaserScan> LaserScans::take()
{
  auto scan = std::make_shared<core::LaserScan>();
  scan->pose_robot_sensor = options_->mount;
  scan->angleMin = -3.124139;  // as the driver says
  scan->angleStep = math::degToRad(1);
  scan->rangeMax = options_->maxRange;
  scan->ranges.reserve(kBeams);
  for (std::size_t i = 2; i < 2 + kBeams; ++i)
  {
    const double range = table_.nonNegative(i);
    const bool isReturn = range > 0 && range <= options_->maxRange;
    scan->ranges.push_back(static_cast<float>(isReturn ? range : 2 * options_->maxRange));
  }
  advance();
  return scan;
}
}  // namespace slamot::importers::scaled_cars
