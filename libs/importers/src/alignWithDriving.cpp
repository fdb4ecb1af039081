#include "alignWithDriving.h"

#include <Eigen/LU>

namespace slamot::importers
{
namespace
{
constexpr double kHalf = 0.1, kLongestGap = 0.1;  // [s]
constexpr double kSlowest = 0.2;                  // [m/s]
constexpr int kFewest = 20;
}  // namespace

std::optional<DrivingDirection> drivingDirection(const eval::Trajectory& path)
{
  Matrix2 squares = Matrix2::Zero();
  Vector2 products = Vector2::Zero();
  double sideways = 0;
  int n = 0;
  for (const eval::TimedPose& now : path.poses)
  {
    const auto before = path.at(now.time - kHalf, kLongestGap);
    const auto after = path.at(now.time + kHalf, kLongestGap);
    if (!before || !after) continue;
    const double span = after->time - before->time;
    const double turned = math::wrapToPi(after->pose.phi - before->pose.phi);
    const Pose2D moved = math::between({before->pose.x, before->pose.y, now.pose.phi},
                                       {after->pose.x, after->pose.y, now.pose.phi});
    const Vector2 along(turned / span, moved.x / span);
    const double across = moved.y / span;
    if (std::hypot(along[1], across) < kSlowest) continue;
    squares += along * along.transpose();
    products += along * across;
    sideways += across * across;
    ++n;
  }
  if (n < kFewest) return std::nullopt;
  // A millimetre's worth of doubt: who never turned does not tell where the tracked point is.
  squares += Matrix2::Identity() * 1e-6 * n;
  const Vector2 fit = squares.inverse() * products;
  const double left = sideways - 2 * fit.dot(products) + fit.dot(squares * fit);
  return DrivingDirection{fit[0], std::atan(fit[1]), std::sqrt(std::max(0.0, left) / n)};
}
}  // namespace slamot::importers
