#include <algorithm>
#include <array>

#include "CarmenLog.h"

namespace slamot::importers::carmen
{
namespace
{
using core::ExitStatus;

constexpr std::size_t kTail = 3;  // ipc_timestamp ipc_hostname logger_timestamp
constexpr std::size_t kPose = 3;

/// What the logger writes and nothing here needs.
constexpr std::array kOthers = {"PARAM",     "SYNC",      "MARKER",    "TRUEPOS",      "RAWLASER1",
                                "RAWLASER2", "RAWLASER3", "RAWLASER4", "RAWLASER5",    "LASER3",
                                "LASER4",    "LASER5",    "SONAR",     "BUMPER",       "IMU",
                                "NMEAGGA",   "NMEARMC",   "ARM",       "POSITIONLASER"};

[[noreturn]] void failLength(const TextTable& row, const std::string& wanted)
{
  row.fail(ExitStatus::kUnreadable,
           std::string(row.text(0)) + " has " + std::to_string(row.columns()) +
               " fields instead of " + wanted,
           "mend or remove the line");
}

Pose2D poseAt(const TextTable& row, std::size_t field)
{
  return {row.number(field), row.number(field + 1), math::wrapToPi(row.number(field + 2))};
}

/// How many beams field `field` says there are; the row must be as long, plus `others` at least.
std::size_t beamsAt(const TextTable& row, std::size_t field, std::size_t others)
{
  if (row.columns() <= field) failLength(row, "at least " + std::to_string(field + 1));
  const auto n = static_cast<std::size_t>(row.integer(field, 0));
  if (row.columns() < field + 1 + n + others)
    failLength(row, "the " + std::to_string(field + 1 + n + others) + " that " + std::to_string(n) +
                        " beams make");
  return n;
}

/// The field of view of SICK's lasers by their number of beams, as CARMEN takes it: of an even
/// number the last one was not logged.
void guessBeams(core::LaserScan& scan, std::size_t n)
{
  const bool quarter = n == 400 || n == 401, half = n == 360 || n == 361;
  const bool whole = n == 180 || n == 181;
  scan.angleMin = math::degToRad(quarter ? -50 : -90);
  if (quarter || half || whole)
    scan.angleStep = math::degToRad(quarter ? 0.25 : half ? 0.5 : 1);
  else
    scan.angleStep = n > 1 ? math::kPi / static_cast<double>(n - 1) : 0;
}

void readRanges(const TextTable& row, std::size_t first, std::size_t n, core::LaserScan& scan)
{
  scan.ranges.reserve(n);
  for (std::size_t i = first; i < first + n; ++i)
  {
    const double range = row.number(i);
    const bool isReturn = range > 0 && range < scan.rangeMax;
    scan.ranges.push_back(static_cast<float>(isReturn ? range : 2 * scan.rangeMax));
  }
}

/// FLASER, RLASER: n, ranges, pose of the laser, pose of the robot.
Message readOldScan(const TextTable& row, const CarmenOptions& options, bool rear)
{
  const std::size_t n = beamsAt(row, 1, 2 * kPose + kTail);
  if (row.columns() != 2 + n + 2 * kPose + kTail)
    failLength(row, std::to_string(2 + n + 2 * kPose + kTail));
  Message out;
  out.odometry = poseAt(row, 2 + n + kPose);
  if (n == 0) return out;
  auto scan = std::make_shared<core::LaserScan>();
  guessBeams(*scan, n);
  scan->angleMin = options.firstBeam.value_or(scan->angleMin);
  scan->angleStep = options.beamStep.value_or(scan->angleStep);
  const auto& mount = rear ? options.rearMount : options.mount;
  scan->pose_robot_sensor = mount.value_or(Pose2D(0, 0, rear ? math::kPi : 0));
  scan->rangeMax = options.maxRange;
  readRanges(row, 2, n, *scan);
  out.scan = std::move(scan);
  return out;
}

/// laser_type start_angle field_of_view angular_resolution maximum_range accuracy remission_mode
void readHeader(const TextTable& row, std::size_t n, core::LaserScan& scan)
{
  scan.angleMin = row.number(2);
  scan.angleStep = row.nonNegative(4);
  const double fieldOfView = row.nonNegative(3);
  if (scan.angleStep == 0 && n > 1) scan.angleStep = fieldOfView / static_cast<double>(n - 1);
  constexpr double kTurn = math::kTwoPi + 0.1;
  if (std::abs(scan.angleMin) > kTurn || scan.angleStep * static_cast<double>(n - 1) > kTurn)
    row.fail(ExitStatus::kNonsense, "the laser sees more than a full turn",
             "write start angle and resolution in radians");
  if (const double logged = row.number(5); logged > 0)
    scan.rangeMax = std::min(scan.rangeMax, logged);
}

/// The logged pose of the laser against the robot's.
Pose2D loggedMount(const TextTable& row, std::size_t poses)
{
  constexpr double kFarthest = 5;  // [m]
  const Pose2D mount = math::between(poseAt(row, poses + kPose), poseAt(row, poses));
  if (std::hypot(mount.x, mount.y) > kFarthest)
    row.fail(ExitStatus::kNonsense, "the laser's pose is over 5 m from the robot's",
             "say where it is: --laser-mount, --rear-laser-mount");
  return mount;
}

/// ROBOTLASER1, ROBOTLASER2, with remissions or, of older loggers, without.
Message readScan(const TextTable& row, const CarmenOptions& options, bool rear)
{
  constexpr std::size_t kCount = 8,
                        kMotion = 4;  // fields: number of beams; tv rv and two distances
  const std::size_t n = beamsAt(row, kCount, 2 * kPose + kMotion + kTail);
  std::size_t poses = kCount + 1 + n;
  if (row.columns() != poses + 2 * kPose + kMotion + kTail)
  {
    const std::size_t remissions = beamsAt(row, poses, 2 * kPose + kMotion + 1 + kTail);
    poses += 1 + remissions;
    if (row.columns() != poses + 2 * kPose + kMotion + 1 + kTail)
      failLength(row, std::to_string(poses + 2 * kPose + kMotion + 1 + kTail));
  }
  Message out;
  out.odometry = poseAt(row, poses + kPose);
  if (n == 0) return out;
  auto scan = std::make_shared<core::LaserScan>();
  scan->rangeMax = options.maxRange;
  readHeader(row, n, *scan);
  const auto& mount = rear ? options.rearMount : options.mount;
  scan->pose_robot_sensor = mount ? *mount : loggedMount(row, poses);
  readRanges(row, kCount + 1, n, *scan);
  out.scan = std::move(scan);
  return out;
}

/// x y theta tv rv accel
Message readOdometry(const TextTable& row)
{
  constexpr std::size_t kFields = 1 + kPose + 3 + kTail;
  if (row.columns() != kFields) failLength(row, std::to_string(kFields));
  Message out;
  out.odometry = poseAt(row, 1);
  out.isOdometry = true;
  return out;
}
}  // namespace

std::optional<Message> readMessage(const TextTable& row, const CarmenOptions& options, bool& known)
{
  const std::string_view kind = row.text(0);
  const bool rear = kind == "RLASER" || kind == "ROBOTLASER2";
  std::optional<Message> out;
  if (kind == "FLASER" || kind == "RLASER") out = readOldScan(row, options, rear);
  if (kind == "ROBOTLASER1" || kind == "ROBOTLASER2") out = readScan(row, options, rear);
  if (kind == "ODOM") out = readOdometry(row);
  known = out || std::find(kOthers.begin(), kOthers.end(), kind) != kOthers.end();
  if (out) out->time = row.number(row.columns() - kTail);
  return out;
}
}  // namespace slamot::importers::carmen
