#include "align.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace slamot::scans
{
namespace
{
constexpr int kMostSteps = 20;
constexpr double kKernel = 3;    // deviations at which a residual counts a quarter
constexpr double kStill = 1e-5;  // [m, rad]: a step this small is the last

struct Sums
{
  Matrix3 H = Matrix3::Zero();
  Vector3 g = Vector3::Zero();
  double weight = 0;
  Matrix3 pretended = Matrix3::Zero();  // of H, what errors of normals only seem to tell

  /// \returns its weight.
  double add(const Vector3& J, double residual, double variance)
  {
    const double chi2 = residual * residual / variance;
    const double root = 1 / (1 + chi2 / (kKernel * kKernel));
    const double w = root * root / variance;
    H += w * J * J.transpose();
    g += w * J * residual;
    weight += root * root;
    return w;
  }
};

Sums sumsAt(const LocalMap& map, const std::vector<Point2D>& points, const Pose2D& pose,
            double rangeStd)
{
  Sums out;
  for (const Point2D& p : points)
  {
    const Point2D q = math::transform(pose, p);
    const Surface* s = map.nearest(q);
    if (!s || !s->isKnown) continue;
    const double variance = rangeStd * rangeStd + s->variance;
    const double dx = q.x - s->centre.x, dy = q.y - s->centre.y;
    const Vector2 lever{-(q.y - pose.y), q.x - pose.x};  // how the point moves as the robot turns
    if (s->isWall)
    {
      const Vector2& n = s->normal;
      const double w = out.add({n.x(), n.y(), n.dot(lever)}, n.x() * dx + n.y() * dy, variance);
      const Vector2 t(-n.y(), n.x());
      const Vector3 along{t.x(), t.y(), t.dot(lever)};
      out.pretended += w * s->tilt * along * along.transpose();
      continue;
    }
    // Both coordinates of one point share its weight.
    const double before = out.weight;
    out.add({1, 0, lever.x()}, dx, variance);
    out.add({0, 1, lever.y()}, dy, variance);
    out.weight = before + (out.weight - before) / 2;
  }
  return out;
}

/// What the points tell.  A normal that is off by chance has a part along the wall, and its square
/// does not average out: without taking it off, a corridor would seem to have features.
Matrix3 informationOf(const Sums& sums)
{
  const Matrix3 H = sums.H - sums.pretended;
  return H + std::max(0.0, -math::smallestEigenvalue(H)) * Matrix3::Identity();
}

Vector3 difference(const Pose2D& a, const Pose2D& b)
{
  return {a.x - b.x, a.y - b.y, math::wrapToPi(a.phi - b.phi)};
}
}  // namespace

Alignment align(const LocalMap& map, const std::vector<Point2D>& points, const Pose2D& start,
                const Gaussian<Pose2D>& expected, double rangeStd, double inflation)
{
  const Matrix3 prior = expected.cov.inverse();
  Alignment out;
  out.pose = start;
  for (int i = 0; i < kMostSteps; ++i)
  {
    const Sums sums = sumsAt(map, points, out.pose, rangeStd);
    const Matrix3 H = sums.H / inflation + prior;
    const Vector3 g = sums.g / inflation + prior * difference(out.pose, expected.mean);
    const Vector3 step = -H.ldlt().solve(g);
    if (!step.allFinite()) break;
    out.pose = {out.pose.x + step[0], out.pose.y + step[1], math::wrapToPi(out.pose.phi + step[2])};
    if (step.cwiseAbs().maxCoeff() < kStill) break;
  }
  const Sums sums = sumsAt(map, points, out.pose, rangeStd);
  out.information = informationOf(sums) / inflation;
  out.explained = points.empty() ? 0 : sums.weight / static_cast<double>(points.size());
  return out;
}
}  // namespace slamot::scans
