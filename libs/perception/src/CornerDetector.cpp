#include <slamot/perception/CornerDetector.h>

#include <Eigen/LU>

#include <cmath>

namespace slamot::perception
{
namespace
{
using Points = std::vector<ScanPoint>;

double distance(const Point2D& a, const Point2D& b)
{
  return std::hypot(a.x - b.x, a.y - b.y);
}

/// Ends of straight parts of points[first..last], from first on.
void split(const Points& points, std::size_t first, std::size_t last, double mostOff,
           std::vector<std::size_t>& ends)
{
  const Point2D &a = points[first].at, &b = points[last].at;
  const double length = std::max(1e-9, distance(a, b));
  double most = 0;
  std::size_t at = first;
  for (std::size_t i = first + 1; i < last; ++i)
  {
    const Point2D& p = points[i].at;
    const double off = std::abs((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x)) / length;
    if (off > most) most = off, at = i;
  }
  if (most <= mostOff)
  {
    ends.push_back(last);
    return;
  }
  split(points, first, at, mostOff, ends);
  split(points, at, last, mostOff, ends);
}

/// Indices of returns, ends included.
struct Stretch
{
  std::size_t first, last;
};

/// Through a stretch's returns, without those at its ends, which may be the next wall's.
LineSegment fit(const Points& points, const Stretch& stretch, double rangeStd)
{
  const std::size_t first = stretch.first == 0 ? 0 : stretch.first + 1;
  const std::size_t last = stretch.last + 1 == points.size() ? stretch.last : stretch.last - 1;
  LineSegment out;
  const double n = static_cast<double>(last - first + 1);
  Vector2 mean = Vector2::Zero();
  for (std::size_t i = first; i <= last; ++i) mean += Vector2(points[i].at.x, points[i].at.y) / n;
  double xx = 0, xy = 0, yy = 0;
  for (std::size_t i = first; i <= last; ++i)
  {
    const Vector2 d = Vector2(points[i].at.x, points[i].at.y) - mean;
    xx += d[0] * d[0], xy += d[0] * d[1], yy += d[1] * d[1];
  }
  double angle = 0.5 * std::atan2(2 * xy, xx - yy);
  const Point2D &a = points[first].at, &b = points[last].at;
  if (std::cos(angle) * (b.x - a.x) + std::sin(angle) * (b.y - a.y) < 0) angle += math::kPi;
  out.middle = {mean[0], mean[1]};
  out.direction = {std::cos(angle), std::sin(angle)};
  const auto along = [&](const Point2D& p)
  { return (p.x - mean[0]) * out.direction.x + (p.y - mean[1]) * out.direction.y; };
  const auto place = [&](double s)
  { return Point2D(mean[0] + s * out.direction.x, mean[1] + s * out.direction.y); };
  out.from = place(along(a));
  out.to = place(along(b));
  const double half = 0.5 * (xx + yy), spread = std::hypot(0.5 * (xx - yy), xy);
  const double variance = std::max(rangeStd * rangeStd, (half - spread) / std::max(1.0, n - 2));
  out.offsetStd = std::sqrt(variance / n);
  out.angleStd = std::sqrt(variance / std::max(1e-9, half + spread));
  out.points = static_cast<int>(n);
  return out;
}
double farthestOff(const Points& points, const Stretch& s, const LineSegment& line)
{
  double most = 0;
  for (std::size_t i = s.first + 1; i < s.last; ++i)
    most = std::max(most, std::abs(line.direction.x * (points[i].at.y - line.middle.y) -
                                   line.direction.y * (points[i].at.x - line.middle.x)));
  return most;
}

/// One wall may have been split where a single return was off: neighbours that are one line are.
void merge(const Points& points, double mostOff, double rangeStd, std::vector<Stretch>& stretches)
{
  for (std::size_t i = 1; i < stretches.size();)
  {
    const Stretch both{stretches[i - 1].first, stretches[i].last};
    const bool touch = stretches[i - 1].last == stretches[i].first;
    if (touch && farthestOff(points, both, fit(points, both, rangeStd)) <= mostOff)
    {
      stretches[i - 1] = both;
      stretches.erase(stretches.begin() + static_cast<std::ptrdiff_t>(i));
    }
    else
      ++i;
  }
}
}  // namespace

LineOptions LineOptions::from(core::Params& p)
{
  LineOptions out;
  out.mostOff = p.positive("max_off_m", out.mostOff);
  out.leastPoints = p.integer("min_points", 3, 1000, out.leastPoints);
  out.leastLength = p.positive("min_length_m", out.leastLength);
  out.sharpest = p.inRange("min_angle_deg", 10, 90, out.sharpest);
  out.flattest = p.inRange("max_angle_deg", 90, 170, out.flattest);
  out.maxRange = p.positive("max_range_m", out.maxRange);
  return out;
}

double LineSegment::stdAt(double along) const
{
  return std::hypot(offsetStd, angleStd * along);
}

std::vector<LineSegment> linesOf(const Cluster& cluster, double rangeStd,
                                 const LineOptions& options)
{
  std::vector<LineSegment> out;
  const Points& points = cluster.points;
  if (static_cast<int>(points.size()) < options.leastPoints) return out;
  std::vector<std::size_t> ends;
  split(points, 0, points.size() - 1, options.mostOff, ends);
  std::vector<Stretch> stretches;
  std::size_t first = 0;
  for (const std::size_t end : ends)
  {
    stretches.push_back({first, end});
    first = end;
  }
  merge(points, options.mostOff, rangeStd, stretches);
  for (const Stretch& s : stretches)
  {
    const LineSegment line = fit(points, s, rangeStd);
    if (line.points >= options.leastPoints && distance(line.from, line.to) >= options.leastLength)
      out.push_back(line);
  }
  return out;
}

std::optional<DetectedLandmark> CornerDetector::cornerOf(const LineSegment& a,
                                                         const LineSegment& b) const
{
  const double turn = std::acos(
      std::clamp(a.direction.x * b.direction.x + a.direction.y * b.direction.y, -1.0, 1.0));
  const double angle = math::kPi - turn;  // between the walls
  if (angle < options_.sharpest || angle > options_.flattest) return std::nullopt;
  Matrix2 normals;
  normals << -a.direction.y, a.direction.x, -b.direction.y, b.direction.x;
  const Vector2 offsets(normals(0, 0) * a.middle.x + normals(0, 1) * a.middle.y,
                        normals(1, 0) * b.middle.x + normals(1, 1) * b.middle.y);
  const Matrix2 inverse = normals.inverse();
  const Vector2 p = inverse * offsets;
  const Point2D at{p[0], p[1]};
  // Walls that end far from where they would meet leave a door there.
  const double gap = std::max(distance(a.to, at), distance(b.from, at));
  if (gap > options_.leastLength) return std::nullopt;
  const double da = a.stdAt(distance(at, a.middle)), db = b.stdAt(distance(at, b.middle));
  DetectedLandmark out;
  out.at.mean = at;
  out.at.cov = inverse * Vector2(da * da, db * db).asDiagonal() * inverse.transpose();
  return out;
}

std::vector<DetectedLandmark> CornerDetector::detect(const core::LaserScan& scan,
                                                     const std::vector<Cluster>& clusters) const
{
  const Point2D laser{scan.pose_robot_sensor.x, scan.pose_robot_sensor.y};
  std::vector<DetectedLandmark> out;
  for (const Cluster& cluster : clusters)
  {
    const auto lines = linesOf(cluster, laser_.rangeStd, options_);
    for (std::size_t i = 1; i < lines.size(); ++i)
      if (const auto corner = cornerOf(lines[i - 1], lines[i]))
        if (distance(corner->at.mean, laser) <= options_.maxRange) out.push_back(*corner);
  }
  return out;
}
}  // namespace slamot::perception
