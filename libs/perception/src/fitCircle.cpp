#include <slamot/perception/fitCircle.h>

#include <Eigen/Cholesky>

#include <cmath>

namespace slamot::perception
{
namespace
{
constexpr int kMostIterations = 20;
constexpr double kConverged = 1e-7;  // [m]

struct Residual
{
  double error, std;  // [m]
  Vector3 slope;      // by (centre, radius)
};

/// A return's range against where its beam meets the circle.  Where the beam grazes or misses it,
/// that place is not defined, or moves too fast to be of use: the return's distance from it then.
Residual residualOf(const ScanPoint& p, const Vector3& circle, const Point2D& laser,
                    double angleStep, double rangeStd)
{
  constexpr double kUniform = 0.29;  // deviation of what is uniform over one
  constexpr double kGrazing = 0.9;   // sine of the angle of incidence
  const Vector2 u((p.at.x - laser.x) / p.range, (p.at.y - laser.y) / p.range);
  const Vector2 d(circle[0] - laser.x, circle[1] - laser.y), left(-u[1], u[0]);
  const double radius = std::max(1e-6, circle[2]), along = u.dot(d), across = left.dot(d);
  const double between = kUniform * p.range * std::abs(angleStep);  // beams, on the way round
  Residual out;
  if (std::abs(across) < kGrazing * radius)
  {
    const double root = std::sqrt(radius * radius - across * across);
    out.error = p.range - (along - root);
    out.std = std::hypot(rangeStd, between * across / root);
    out.slope << -u - across / root * left, radius / root;
    return out;
  }
  const Vector2 off(p.at.x - circle[0], p.at.y - circle[1]);
  const double distance = std::max(1e-6, off.norm());
  out.error = distance - radius;
  out.std = std::hypot(rangeStd, between);
  out.slope << -off / distance, -1;
  return out;
}

struct Solution
{
  Vector3 circle;
  Matrix3 cov;
};

std::optional<Solution> solve(const std::vector<ScanPoint>& points, Vector3 circle,
                              const Point2D& laser, double angleStep, double rangeStd,
                              const Roundness& prior)
{
  for (int i = 0; i < kMostIterations; ++i)
  {
    Matrix3 information = Matrix3::Zero();
    Vector3 pull = Vector3::Zero();
    const double priorWeight = 1 / (prior.radiusStd * prior.radiusStd);
    information(2, 2) = priorWeight;
    pull[2] = priorWeight * (prior.radius - circle[2]);
    for (const ScanPoint& p : points)
    {
      const Residual r = residualOf(p, circle, laser, angleStep, rangeStd);
      const double weight = 1 / (r.std * r.std);
      information += weight * r.slope * r.slope.transpose();
      pull -= weight * r.error * r.slope;
    }
    const Eigen::LDLT<Matrix3> ldlt(information);
    if (!ldlt.isPositive() || ldlt.vectorD().minCoeff() <= 0) return std::nullopt;
    Vector3 step = ldlt.solve(pull);
    if (!step.allFinite()) return std::nullopt;
    const double longest = std::max(prior.radius, 0.05);  // two returns leave much room at first
    if (step.norm() > longest) step *= longest / step.norm();
    circle += step;
    if (step.norm() < kConverged || i + 1 == kMostIterations)
      return Solution{circle, ldlt.solve(Matrix3::Identity())};
  }
  return std::nullopt;
}
}  // namespace

std::optional<CircleFit> fitCircle(const std::vector<ScanPoint>& points, const Point2D& laser,
                                   double angleStep, double rangeStd, const Roundness& prior)
{
  if (points.size() < 2) return std::nullopt;
  // From the middle return, a radius farther on.
  const ScanPoint& middle = points[points.size() / 2];
  const double stretch = 1 + prior.radius / middle.range;
  const Vector3 start(laser.x + stretch * (middle.at.x - laser.x),
                      laser.y + stretch * (middle.at.y - laser.y), prior.radius);
  auto found = solve(points, start, laser, angleStep, rangeStd, prior);
  if (!found) return std::nullopt;
  std::vector<ScanPoint> kept;
  for (const ScanPoint& p : points)
  {
    const Residual r = residualOf(p, found->circle, laser, angleStep, rangeStd);
    if (std::abs(r.error) <= 3 * r.std) kept.push_back(p);
  }
  if (kept.size() < points.size() && kept.size() >= 2)
    found = solve(kept, found->circle, laser, angleStep, rangeStd, prior);
  else
    kept = points;
  if (!found) return std::nullopt;

  CircleFit out;
  out.points = static_cast<int>(kept.size());
  for (const ScanPoint& p : kept)
  {
    const Residual r = residualOf(p, found->circle, laser, angleStep, rangeStd);
    out.misfit += r.error * r.error / (r.std * r.std * static_cast<double>(kept.size()));
  }
  const double scale = std::max(1.0, out.misfit);
  out.center.mean = {found->circle[0], found->circle[1]};
  out.center.cov = scale * found->cov.topLeftCorner<2, 2>();
  out.radius = found->circle[2];
  out.radiusStd = std::sqrt(scale * found->cov(2, 2));
  const double away = std::hypot(out.center.mean.x - laser.x, out.center.mean.y - laser.y);
  if (!(out.radius > 0) || away < middle.range - 3 * rangeStd) return std::nullopt;
  return out;
}
}  // namespace slamot::perception
