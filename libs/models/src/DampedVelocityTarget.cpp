#include <slamot/models/DampedVelocityTarget.h>

#include <cmath>

#include "headingOf.h"

namespace slamot::models
{
using Start = core::ObjectStart;

DampedVelocityTarget::Params DampedVelocityTarget::Params::from(core::Params& p)
{
  return {p.positive("target_velocity_std_mps", 1.0), p.positive("target_velocity_time_s", 10.0)};
}

DampedVelocityTarget::State DampedVelocityTarget::start(const Start& start) const
{
  State s;
  const double v2 = params_.velocityStd * params_.velocityStd;
  const auto velocityVar = [&](Start::Field f)
  { return start.value[f] ? std::pow(start.getStd(f), 2) : v2; };
  s.x << start.get(Start::kX), start.get(Start::kY), start.get(Start::kVx), start.get(Start::kVy);
  s.P.diagonal() << std::pow(start.getStd(Start::kX), 2), std::pow(start.getStd(Start::kY), 2),
      velocityVar(Start::kVx), velocityVar(Start::kVy);
  return s;
}

DampedVelocityTarget::State DampedVelocityTarget::birth(const Gaussian<Point2D>& place) const
{
  State s;
  s.x.head<2>() << place.mean.x, place.mean.y;
  s.P.topLeftCorner<2, 2>() = place.cov;
  s.P(2, 2) = s.P(3, 3) = params_.velocityStd * params_.velocityStd;
  return s;
}

namespace
{
TargetTransition<4> transition(double velocityStd, double T, double dt)
{
  // Integrated Ornstein-Uhlenbeck process: Bar-Shalom, Li, Kirubarajan 2001, section 6.2 (Singer),
  // with the velocity in the acceleration's place.
  const double e = std::exp(-dt / T), v2 = velocityStd * velocityStd;
  TargetTransition<4> out;
  const double g = T * (1 - e);
  out.F(0, 2) = out.F(1, 3) = g;
  out.F(2, 2) = out.F(3, 3) = e;
  const double qvv = v2 * (1 - e * e);
  const double qpv = v2 * T * (1 - e) * (1 - e);
  const double qpp = std::max(0.0, v2 * T * (2 * dt - T * (3 - 4 * e + e * e)));
  for (int axis = 0; axis < 2; ++axis)
  {
    out.Q(axis, axis) = qpp;
    out.Q(axis, axis + 2) = out.Q(axis + 2, axis) = qpv;
    out.Q(axis + 2, axis + 2) = qvv;
  }
  return out;
}
}  // namespace

TargetTransition<4> DampedVelocityTarget::move(State& s, double dt) const
{
  const auto t = transition(params_.velocityStd, params_.velocityTime, dt);
  s.x = (t.F * s.x).eval();
  return t;
}

TargetTransition<4> DampedVelocityTarget::kinematicTransition(const Eigen::Matrix<double, 4, 1>&,
                                                              double dt) const
{
  return transition(params_.velocityStd, params_.velocityTime, dt);
}

Kinematics<4, 4> DampedVelocityTarget::kinematics(const State& s)
{
  return {s.x, Eigen::Matrix4d::Identity()};
}

void DampedVelocityTarget::widen(State& s, const Matrix3& poseCov)
{
  Eigen::Matrix<double, 4, 3> G = Eigen::Matrix<double, 4, 3>::Zero();  // a turn turns the velocity
  G.topLeftCorner<2, 2>().setIdentity();
  G(2, 2) = -s.x[3];
  G(3, 2) = s.x[2];
  s.P += G * poseCov * G.transpose();
}

Gaussian<Pose2D> DampedVelocityTarget::pose(const State& s)
{
  return poseOf(s.point(), s.pointCov(), s.x.tail<2>(), s.P.bottomRightCorner<2, 2>());
}

Vector2 DampedVelocityTarget::velocity(const State& s, Matrix2& cov)
{
  cov = s.P.bottomRightCorner<2, 2>();
  return s.x.tail<2>();
}
}  // namespace slamot::models
