#include <slamot/eval/ScanMap.h>

#include <cmath>
#include <limits>
#include <unordered_map>

namespace slamot::eval
{
namespace
{
constexpr double kFarthest = 30;  // [m]: beyond, beams lie too far apart to draw walls
constexpr std::size_t kMostPoints = 200000, kMostQueries = 50000, kFewest = 6;
constexpr double kRounding = 0.01;  // [m]

using Cells = std::unordered_map<std::uint64_t, std::vector<Point2D>>;

std::uint64_t cellOf(std::int64_t x, std::int64_t y)
{
  return static_cast<std::uint64_t>(x) * 0x9e3779b97f4a7c15u ^ static_cast<std::uint64_t>(y);
}
std::int64_t indexOf(double v, double size)
{
  return static_cast<std::int64_t>(std::floor(v / size));
}

/// Sums over neighbours, relative to the point itself.
struct Moments
{
  double n = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;

  void add(double dx, double dy)
  {
    n += 1, x += dx, y += dy;
    xx += dx * dx, xy += dx * dy, yy += dy * dy;
  }
  [[nodiscard]] double entropy() const
  {
    const double a = (xx - x * x / n) / (n - 1) + kRounding * kRounding;
    const double b = (xy - x * y / n) / (n - 1);
    const double c = (yy - y * y / n) / (n - 1) + kRounding * kRounding;
    return std::log(2 * math::kPi) + 1 + 0.5 * std::log(a * c - b * b);
  }
};

Moments around(const Cells& cells, const Point2D& p, double radius)
{
  Moments out;
  const std::int64_t x = indexOf(p.x, radius), y = indexOf(p.y, radius);
  for (std::int64_t i = x - 1; i <= x + 1; ++i)
    for (std::int64_t j = y - 1; j <= y + 1; ++j)
    {
      const auto cell = cells.find(cellOf(i, j));
      if (cell == cells.end()) continue;
      for (const Point2D& q : cell->second)
      {
        const double dx = q.x - p.x, dy = q.y - p.y;
        if (dx * dx + dy * dy <= radius * radius) out.add(dx, dy);
      }
    }
  return out;
}

/// f(index of a beam, its end in the frame that the robot's pose is given in).
template <class F>
void forReturns(const core::LaserScan& scan, const Pose2D& robot, F&& f)
{
  const Pose2D sensor = math::compose(robot, scan.pose_robot_sensor);
  for (std::size_t i = 0; i < scan.ranges.size(); ++i)
  {
    const double r = scan.ranges[i];
    if (!(r > 0 && r < scan.rangeMax)) continue;
    const double a = scan.angleMin + static_cast<double>(i) * scan.angleStep;
    f(i, math::transform(sensor, {r * std::cos(a), r * std::sin(a)}));
  }
}
std::optional<Pose2D> robotAt(const Record& record, std::size_t index, PosesOf poses)
{
  const RobotRow& row = record.rows[index];
  if (poses == PosesOf::kFilter) return row.robot.mean;
  if (poses == PosesOf::kOdometry)
    return record.hasOdometry ? std::optional<Pose2D>(row.odometry) : std::nullopt;
  const auto onPath = record.path.at(row.time);
  return onPath ? std::optional<Pose2D>(onPath->pose) : std::nullopt;
}
}  // namespace

std::vector<LaserRow> withoutTargets(const Record& record, double radius)
{
  std::unordered_map<std::size_t, std::vector<Point2D>> places;  // of targets, by row
  for (const TargetTrack& track : record.targets)
    for (const TargetRow& t : track.rows) places[t.row].push_back({t.pose.mean.x, t.pose.mean.y});
  std::vector<LaserRow> out = record.lasers;
  for (LaserRow& row : out)
  {
    const auto targets = places.find(row.row);
    if (targets == places.end()) continue;
    auto cleaned = std::make_shared<core::LaserScan>(*row.scan);
    forReturns(*row.scan, record.rows[row.row].robot.mean,
               [&](std::size_t beam, const Point2D& p)
               {
                 for (const Point2D& t : targets->second)
                   if (std::hypot(p.x - t.x, p.y - t.y) < radius)
                     cleaned->ranges[beam] = std::numeric_limits<float>::infinity();
               });
    row.scan = std::move(cleaned);
  }
  return out;
}

std::vector<Point2D> scanPoints(const Record& record, PosesOf poses)
{
  std::vector<Point2D> all;
  for (const LaserRow& laser : record.lasers)
  {
    const auto robot = robotAt(record, laser.row, poses);
    if (!robot) continue;
    forReturns(*laser.scan, *robot,
               [&](std::size_t beam, const Point2D& p)
               {
                 if (laser.scan->ranges[beam] < kFarthest) all.push_back(p);
               });
  }
  const std::size_t stride = (all.size() + kMostPoints - 1) / kMostPoints;
  if (stride <= 1) return all;
  std::vector<Point2D> out;
  for (std::size_t i = 0; i < all.size(); i += stride) out.push_back(all[i]);
  return out;
}

std::optional<double> meanMapEntropy(const std::vector<Point2D>& points, double radius)
{
  Cells cells;
  for (const Point2D& p : points)
    cells[cellOf(indexOf(p.x, radius), indexOf(p.y, radius))].push_back(p);
  double sum = 0;
  std::size_t n = 0;
  const std::size_t stride = (points.size() + kMostQueries - 1) / kMostQueries;
  for (std::size_t i = 0; i < points.size(); i += stride)
  {
    const Moments m = around(cells, points[i], radius);
    if (m.n < kFewest) continue;
    sum += m.entropy();
    ++n;
  }
  if (n == 0) return std::nullopt;
  return sum / static_cast<double>(n);
}

std::optional<ScanMapQuality> scanMapQuality(const Record& record)
{
  if (record.lasers.empty()) return std::nullopt;
  const auto points = scanPoints(record, PosesOf::kFilter);
  ScanMapQuality out;
  out.points = points.size();
  out.entropy = meanMapEntropy(points);
  out.pathEntropy = meanMapEntropy(scanPoints(record, PosesOf::kPath));
  out.odometryEntropy = meanMapEntropy(scanPoints(record, PosesOf::kOdometry));
  return out;
}
}  // namespace slamot::eval
