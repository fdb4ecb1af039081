#include <slamot/importers/HeldMotion.h>

#include <Eigen/LU>

namespace slamot::importers
{
namespace
{
// sin(a)/a and (1 - cos(a))/a: the matrix that takes a constant velocity to its displacement.
Matrix2 arc(double a)
{
  const bool small = std::abs(a) < 1e-4;
  const double s = small ? 1 - a * a / 6 : std::sin(a) / a;
  const double c = small ? a / 2 : (1 - std::cos(a)) / a;
  Matrix2 m;
  m << s, -c, c, s;
  return m;
}
}  // namespace

HeldMotion HeldMotion::fromVelocities(double v, double omega, double dt, double stdV,
                                      double stdOmega)
{
  HeldMotion out;
  out.whole_ = math::turnThenMove(v, omega, dt, stdV, stdOmega);
  out.first_ = v * dt;
  out.turn_ = omega * dt;
  out.turnsFirst_ = true;
  return out;
}

HeldMotion HeldMotion::fromIncrement(const Gaussian<Pose2D>& whole)
{
  HeldMotion out;
  out.whole_ = whole;
  out.turn_ = math::wrapToPi(whole.mean.phi);
  const Vector2 velocity = arc(out.turn_).inverse() * Vector2(whole.mean.x, whole.mean.y);
  out.first_ = velocity[0];
  out.second_ = velocity[1];
  return out;
}

Pose2D HeldMotion::at(double share) const
{
  if (share >= 1) return whole_.mean;
  const double turned = turn_ * share;
  if (turnsFirst_)
    return {first_ * share * std::cos(turned), first_ * share * std::sin(turned),
            math::wrapToPi(turned)};
  const Vector2 moved = arc(turned) * Vector2(first_, second_) * share;
  return {moved[0], moved[1], turned};
}

Gaussian<Pose2D> HeldMotion::part(double from, double to) const
{
  if (from <= 0 && to >= 1) return whole_;
  const Pose2D begin = at(from), end = at(to);
  // Each part brings its share of the whole's error as felt at the whole's end; carried back to the
  // part's own end and axes, composition adds the shares up again.
  Matrix3 back = Matrix3::Identity();
  back(0, 2) = whole_.mean.y - end.y;
  back(1, 2) = end.x - whole_.mean.x;
  const Matrix3 m = math::poseRotation(-begin.phi) * back;
  const Matrix3 cov = (to - from) * (m * whole_.cov * m.transpose());
  Gaussian<Pose2D> out;
  out.mean = math::between(begin, end);
  out.cov = 0.5 * (cov + cov.transpose());
  return out;
}
}  // namespace slamot::importers
