#include "boxBeams.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace slamot::moving
{
namespace
{
using B = BoxState;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A face across the box's x or y axis, on its positive or negative side; no side: not seen.
struct Face
{
  int axis;
  double side;
};

struct Seen
{
  explicit Seen(const BoxState& box, const Point2D& laser)
      : half{0.5 * box.x[B::kLength], 0.5 * box.x[B::kWidth]}
  {
    const Point2D q = inBox(box, laser);
    from = {q.x, q.y};
    for (const int axis : {0, 1})
      side[axis] = from[axis] > half[axis] ? 1 : from[axis] < -half[axis] ? -1 : 0;
  }

  /// The face that a beam through a point of the box's axes meets: the last whose line it crosses.
  [[nodiscard]] Face met(const Point2D& p) const
  {
    const std::array<double, 2> to{p.x, p.y};
    std::array<double, 2> when{-kInfinity, -kInfinity};
    for (const int axis : {0, 1})
    {
      const double along = to[axis] - from[axis];
      if (side[axis] != 0 && side[axis] * along < 0)
        when[axis] = (side[axis] * half[axis] - from[axis]) / along;
    }
    const int axis = when[1] > when[0] ? 1 : 0;
    return {axis, side[axis]};
  }

  std::array<double, 2> half, from{}, side{};
};

Residual onFace(const BoxState& box, const Seen& seen, const Face& face, const Point2D& local)
{
  const double c = std::cos(box.x[B::kPhi]), s = std::sin(box.x[B::kPhi]), side = face.side;
  Residual out;
  out.value = side * (face.axis == 0 ? local.x : local.y) - seen.half[face.axis];
  out.jacobian[B::kX] = -side * (face.axis == 0 ? c : -s);
  out.jacobian[B::kY] = -side * (face.axis == 0 ? s : c);
  out.jacobian[B::kPhi] = face.axis == 0 ? side * local.y : -side * local.x;
  out.jacobian[face.axis == 0 ? B::kLength : B::kWidth] = -0.5;
  return out;
}

struct Corner
{
  double bearing;  // [rad]
  double x, y;     // signs of its place in the box
};

/// The outermost corner, seen from the laser: `sign` 1 to the left, -1 to the right.
Corner outermost(const BoxState& box, const Point2D& laser, double sign)
{
  const double middle = std::atan2(box.x[B::kY] - laser.y, box.x[B::kX] - laser.x);
  Corner best{0, 0, 0};
  double most = -kInfinity;
  for (const double x : {-1.0, 1.0})
    for (const double y : {-1.0, 1.0})
    {
      const Point2D at =
          math::transform(box.pose(), {0.5 * x * box.x[B::kLength], 0.5 * y * box.x[B::kWidth]});
      const double bearing = std::atan2(at.y - laser.y, at.x - laser.x);
      const double out = sign * math::wrapToPi(bearing - middle);
      if (out > most) most = out, best = {bearing, x, y};
    }
  return best;
}

Residual atEnd(const BoxState& box, const BoxView& view, const End& measured, double sign,
               const MovingOptions& options)
{
  const Corner corner = outermost(box, view.laser, sign);
  const double c = std::cos(box.x[B::kPhi]), s = std::sin(box.x[B::kPhi]);
  const Point2D local{0.5 * corner.x * box.x[B::kLength], 0.5 * corner.y * box.x[B::kWidth]};
  const Point2D at = math::transform(box.pose(), local);
  const double dx = at.x - view.laser.x, dy = at.y - view.laser.y;
  const double squared = std::max(dx * dx + dy * dy, 1e-4);
  const Eigen::RowVector2d byPoint(-dy / squared, dx / squared);
  Residual out;
  out.value = math::wrapToPi(corner.bearing - measured.bearing);
  out.jacobian[B::kX] = byPoint[0];
  out.jacobian[B::kY] = byPoint[1];
  out.jacobian[B::kPhi] =
      byPoint.dot(Eigen::RowVector2d(-s * local.x - c * local.y, c * local.x - s * local.y));
  out.jacobian[B::kLength] =
      byPoint.dot(Eigen::RowVector2d(0.5 * corner.x * c, 0.5 * corner.x * s));
  out.jacobian[B::kWidth] =
      byPoint.dot(Eigen::RowVector2d(-0.5 * corner.y * s, 0.5 * corner.y * c));
  // Corners are round.
  out.variance = measured.std * measured.std + options.shapeStd * options.shapeStd / squared;
  return out;
}
}  // namespace

Point2D inBox(const BoxState& box, const Point2D& p)
{
  const double c = std::cos(box.x[B::kPhi]), s = std::sin(box.x[B::kPhi]);
  const double dx = p.x - box.x[B::kX], dy = p.y - box.x[B::kY];
  return {c * dx + s * dy, -s * dx + c * dy};
}

Point2D nearestOnOutline(const BoxState& box, const Point2D& p)
{
  const Point2D q = inBox(box, p);
  const double a = 0.5 * box.x[B::kLength], b = 0.5 * box.x[B::kWidth];
  Point2D on{std::clamp(q.x, -a, a), std::clamp(q.y, -b, b)};
  if (std::abs(q.x) < a && std::abs(q.y) < b)
    (a - std::abs(q.x) < b - std::abs(q.y) ? on.x : on.y) =
        a - std::abs(q.x) < b - std::abs(q.y) ? std::copysign(a, q.x) : std::copysign(b, q.y);
  return math::transform(box.pose(), on);
}

double distanceToOutline(const BoxState& box, const Point2D& p)
{
  const Point2D q = inBox(box, p);
  const double dx = std::abs(q.x) - 0.5 * box.x[B::kLength];
  const double dy = std::abs(q.y) - 0.5 * box.x[B::kWidth];
  if (dx <= 0 && dy <= 0) return -std::max(dx, dy);
  return std::hypot(std::max(dx, 0.0), std::max(dy, 0.0));
}

std::vector<Residual> residualsOf(const BoxState& box, const BoxView& view,
                                  const MovingOptions& options)
{
  const Seen seen(box, view.laser);
  std::vector<Residual> out;
  if (seen.side[0] == 0 && seen.side[1] == 0) return out;  // the laser is inside
  std::array<int, 2> count{};
  std::vector<int> axes;
  for (const Point2D& p : view.points)
  {
    const Point2D local = inBox(box, p);
    Face face = seen.met(local);
    if (face.side == 0) face = {1 - face.axis, seen.side[1 - face.axis]};
    out.push_back(onFace(box, seen, face, local));
    axes.push_back(face.axis);
    ++count[face.axis];
  }
  const double range = options.laser.rangeStd * options.laser.rangeStd;
  const double shape = options.shapeStd * options.shapeStd;
  for (std::size_t i = 0; i < out.size(); ++i) out[i].variance = range + count[axes[i]] * shape;
  if (view.right) out.push_back(atEnd(box, view, *view.right, -1, options));
  if (view.left) out.push_back(atEnd(box, view, *view.left, 1, options));
  return out;
}
}  // namespace slamot::moving
