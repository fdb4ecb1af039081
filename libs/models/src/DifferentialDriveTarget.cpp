#include <slamot/models/DifferentialDriveTarget.h>

#include <cmath>

#include "headingOf.h"

namespace slamot::models
{
using Start = core::ObjectStart;

DifferentialDriveTarget::Params DifferentialDriveTarget::Params::from(core::Params& p)
{
  return {p.nonNegative("target_speed_mps"),
          p.nonNegative("target_speed_std_mps", 0.0),
          p.number("target_turn_rate_deg_per_s"),
          p.nonNegative("target_turn_rate_std_deg_per_s", 0.0),
          p.nonNegative("target_speed_noise_mps"),
          p.nonNegative("target_turn_rate_noise_deg_per_s"),
          p.nonNegative("target_speed_walk_mps_per_sqrt_s", 0.0),
          p.nonNegative("target_turn_rate_walk_deg_per_s_per_sqrt_s", 0.0)};
}

DifferentialDriveTarget::State DifferentialDriveTarget::start(const Start& start) const
{
  State s;
  const bool moving = start.value[Start::kVx] && start.value[Start::kVy];
  const Vector2 v(start.get(Start::kVx), start.get(Start::kVy));
  const double vVar = std::pow(start.getStd(Start::kVx), 2);
  const auto [course, courseVar] = headingOf(v, vVar * Matrix2::Identity());
  s.headed = start.value[Start::kTheta] || moving;
  const double phi = start.get(Start::kTheta, course);
  const double phiVar =
      start.value[Start::kTheta] ? std::pow(start.getStd(Start::kTheta), 2) : courseVar;
  s.x << start.get(Start::kX), start.get(Start::kY), math::wrapToPi(phi),
      moving ? v.norm() : params_.speed, params_.turnRate;
  s.P.diagonal() << std::pow(start.getStd(Start::kX), 2), std::pow(start.getStd(Start::kY), 2),
      phiVar, moving ? vVar : std::pow(params_.speedStd, 2), std::pow(params_.turnRateStd, 2);
  s.anchor = s.point();
  s.anchorCov = s.pointCov();
  return s;
}

DifferentialDriveTarget::State DifferentialDriveTarget::birth(const Gaussian<Point2D>& place) const
{
  State s;
  s.headed = false;
  s.anchor = place.mean;
  s.anchorCov = place.cov;
  s.x << place.mean.x, place.mean.y, 0, params_.speed, params_.turnRate;
  s.P.topLeftCorner<2, 2>() = place.cov;
  s.P.diagonal().tail<3>() << kUnknownHeadingVar, std::pow(params_.speedStd, 2),
      std::pow(params_.turnRateStd, 2);
  return s;
}

TargetTransition<5> DifferentialDriveTarget::move(State& s, double dt) const
{
  TargetTransition<5> out;
  if (!s.headed)
  {
    s.sinceAnchor += dt;
    const double reach = std::hypot(s.x[3], std::sqrt(s.P(3, 3))) * dt;
    // Steps in one direction add up: the deviation grows with time, not with its square root.
    const double std = std::sqrt(std::max(s.P(0, 0), s.P(1, 1)));
    out.Q(0, 0) = out.Q(1, 1) = (reach * reach + 2 * reach * std) * 0.5;
    return out;
  }
  const double a = s.x[2] + s.x[4] * dt, c = std::cos(a), sn = std::sin(a), v = s.x[3];
  s.x[0] += v * dt * c;
  s.x[1] += v * dt * sn;
  s.x[2] = math::wrapToPi(a);
  auto& F = out.F;
  F(0, 2) = -v * dt * sn;
  F(1, 2) = v * dt * c;
  F(0, 3) = dt * c;
  F(1, 3) = dt * sn;
  F(0, 4) = -v * dt * dt * sn;
  F(1, 4) = v * dt * dt * c;
  F(2, 4) = dt;
  const Eigen::Matrix<double, 3, 2> G = F.topRightCorner<3, 2>();
  const Vector2 q(params_.speedNoise * params_.speedNoise,
                  params_.turnRateNoise * params_.turnRateNoise);
  out.Q.topLeftCorner<3, 3>() = G * q.asDiagonal() * G.transpose();
  out.Q(3, 3) = params_.speedWalk * params_.speedWalk * dt;
  out.Q(4, 4) = params_.turnRateWalk * params_.turnRateWalk * dt;
  return out;
}

bool DifferentialDriveTarget::afterCorrection(State& s, const Gaussian<Point2D>* seenAt) const
{
  s.x[2] = math::wrapToPi(s.x[2]);
  if (s.headed || !seenAt || s.sinceAnchor <= 0) return false;
  const Vector2 d(seenAt->mean.x - s.anchor.x, seenAt->mean.y - s.anchor.y);
  const Matrix2 cov = s.anchorCov + seenAt->cov;
  constexpr double kClearMove =
      9.0;  // three deviations: the direction is good to a third of a radian
  if (d.squaredNorm() < kClearMove * cov.trace()) return false;
  const double dt = s.sinceAnchor, distance = d.norm();
  const auto [course, courseVar] = headingOf(d / dt, cov / (dt * dt));
  // The chord's direction lags the heading by half the turn made meanwhile.
  s.x[2] = math::wrapToPi(course + 0.5 * s.x[4] * dt);
  const double lagVar = 0.25 * dt * dt * s.P(4, 4);
  s.P.setZero();
  s.P.topLeftCorner<2, 2>() = seenAt->cov;
  s.P(2, 2) = courseVar + lagVar;
  s.P(4, 4) = params_.turnRateStd * params_.turnRateStd;
  const double priorVar = params_.speedStd * params_.speedStd;
  const double chordVar = d.dot(cov * d) / (distance * distance * dt * dt);
  if (priorVar > 0)
  {
    const double gain = priorVar / (priorVar + chordVar);
    s.x[3] += gain * (distance / dt - s.x[3]);
    s.P(3, 3) = (1 - gain) * priorVar;
  }
  s.x.head<2>() << seenAt->mean.x, seenAt->mean.y;
  s.headed = true;
  return true;
}

void DifferentialDriveTarget::widen(State& s, const Matrix3& poseCov)
{
  s.P.topLeftCorner<3, 3>() += poseCov;
  s.anchorCov += poseCov.topLeftCorner<2, 2>();
}

Gaussian<Pose2D> DifferentialDriveTarget::pose(const State& s)
{
  Gaussian<Pose2D> out{{s.x[0], s.x[1], s.x[2]}, s.P.topLeftCorner<3, 3>()};
  if (out.cov(2, 2) > kUnknownHeadingVar)
  {
    // More than nothing can't be unknown: shrink the heading's row with its variance.
    const double f = std::sqrt(kUnknownHeadingVar / out.cov(2, 2));
    out.cov.row(2) *= f;
    out.cov.col(2) *= f;
  }
  return out;
}

Vector2 DifferentialDriveTarget::velocity(const State& s, Matrix2& cov)
{
  const double c = std::cos(s.x[2]), sn = std::sin(s.x[2]), v = s.x[3];
  Matrix2 J;
  J << -v * sn, c, v * c, sn;
  cov = J * s.P.block<2, 2>(2, 2) * J.transpose();
  return {v * c, v * sn};
}

Kinematics<4, 5> DifferentialDriveTarget::kinematics(const State& s)
{
  const double c = std::cos(s.x[2]), sn = std::sin(s.x[2]), v = s.x[3];
  Kinematics<4, 5> out;
  out.value << s.x[0], s.x[1], v * c, v * sn;
  out.jacobian.setZero();
  out.jacobian(0, 0) = out.jacobian(1, 1) = 1;
  out.jacobian.block<2, 2>(2, 2) << -v * sn, c, v * c, sn;
  return out;
}

TargetTransition<4> DifferentialDriveTarget::kinematicTransition(
    const Eigen::Matrix<double, 4, 1>& x, double dt) const
{
  TargetTransition<4> t;
  t.F(0, 2) = t.F(1, 3) = dt;
  const double turn = std::hypot(x[2], x[3]) *
                      std::hypot(params_.turnRate, params_.turnRateStd, params_.turnRateNoise) * dt;
  const double velocityVar = turn * turn + params_.speedWalk * params_.speedWalk * dt;
  const double placeVar = dt * dt * (velocityVar + params_.speedNoise * params_.speedNoise);
  t.Q.diagonal() << placeVar, placeVar, velocityVar, velocityVar;
  return t;
}
}  // namespace slamot::models
