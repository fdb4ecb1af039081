#include <slamot/models/TargetMotion.h>

#include <algorithm>
#include <cmath>

namespace slamot::models
{
namespace
{
// Variance of a heading of which nothing is known: uniform over a full turn.
constexpr double kUnknownHeadingVar = math::kPi * math::kPi / 3.0;

using Start = core::ObjectStart;

/// Heading and its variance of a velocity: first order, at most that of an unknown one.
std::pair<double, double> headingOf(const Vector2& v, const Matrix2& cov)
{
  const double q = v.squaredNorm();
  if (q <= 0) return {0.0, kUnknownHeadingVar};
  const Vector2 across(-v[1] / q, v[0] / q);
  return {std::atan2(v[1], v[0]), std::min(kUnknownHeadingVar, across.dot(cov * across))};
}
}  // namespace

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

void DifferentialDriveTarget::predict(State& s, double dt) const
{
  if (!s.headed)
  {
    s.sinceAnchor += dt;
    const double reach = std::hypot(s.x[3], std::sqrt(s.P(3, 3))) * dt;
    // Steps in one direction add up: the deviation grows with time, not with its square root.
    const double std = std::sqrt(std::max(s.P(0, 0), s.P(1, 1)));
    s.P.topLeftCorner<2, 2>() += (reach * reach + 2 * reach * std) * 0.5 * Matrix2::Identity();
    return;
  }
  const double a = s.x[2] + s.x[4] * dt, c = std::cos(a), sn = std::sin(a), v = s.x[3];
  s.x[0] += v * dt * c;
  s.x[1] += v * dt * sn;
  s.x[2] = math::wrapToPi(a);
  Eigen::Matrix<double, 5, 5> F = Eigen::Matrix<double, 5, 5>::Identity();
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
  s.P = (F * s.P * F.transpose()).eval();
  s.P.topLeftCorner<3, 3>() += G * q.asDiagonal() * G.transpose();
  s.P(3, 3) += params_.speedWalk * params_.speedWalk * dt;
  s.P(4, 4) += params_.turnRateWalk * params_.turnRateWalk * dt;
  s.P = (0.5 * (s.P + s.P.transpose())).eval();
}

void DifferentialDriveTarget::afterCorrection(State& s, const Gaussian<Point2D>* seenAt) const
{
  s.x[2] = math::wrapToPi(s.x[2]);
  if (s.headed || !seenAt || s.sinceAnchor <= 0) return;
  const Vector2 d(seenAt->mean.x - s.anchor.x, seenAt->mean.y - s.anchor.y);
  const Matrix2 cov = s.anchorCov + seenAt->cov;
  constexpr double kClearMove =
      9.0;  // three deviations: the direction is good to a third of a radian
  if (d.squaredNorm() < kClearMove * cov.trace()) return;
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

DampedVelocityTarget::Params DampedVelocityTarget::Params::from(core::Params& p)
{
  return {p.positive("target_velocity_std_mps"), p.positive("target_velocity_time_s")};
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

void DampedVelocityTarget::predict(State& s, double dt) const
{
  // Integrated Ornstein-Uhlenbeck process: Bar-Shalom, Li, Kirubarajan 2001, section 6.2 (Singer),
  // with the velocity in the acceleration's place.
  const double T = params_.velocityTime, e = std::exp(-dt / T),
               v2 = params_.velocityStd * params_.velocityStd;
  const double g = T * (1 - e);
  Eigen::Matrix4d F = Eigen::Matrix4d::Identity();
  F(0, 2) = F(1, 3) = g;
  F(2, 2) = F(3, 3) = e;
  const double qvv = v2 * (1 - e * e);
  const double qpv = v2 * T * (1 - e) * (1 - e);
  const double qpp = std::max(0.0, v2 * T * (2 * dt - T * (3 - 4 * e + e * e)));
  s.x = (F * s.x).eval();
  s.P = (F * s.P * F.transpose()).eval();
  for (int axis = 0; axis < 2; ++axis)
  {
    s.P(axis, axis) += qpp;
    s.P(axis, axis + 2) += qpv;
    s.P(axis + 2, axis) += qpv;
    s.P(axis + 2, axis + 2) += qvv;
  }
  s.P = (0.5 * (s.P + s.P.transpose())).eval();
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
  Gaussian<Pose2D> out;
  const Vector2 v = s.x.tail<2>();
  const auto [course, courseVar] = headingOf(v, s.P.bottomRightCorner<2, 2>());
  out.mean = {s.x[0], s.x[1], course};
  out.cov.topLeftCorner<2, 2>() = s.pointCov();
  out.cov(2, 2) = courseVar;
  return out;
}

Vector2 DampedVelocityTarget::velocity(const State& s, Matrix2& cov)
{
  cov = s.P.bottomRightCorner<2, 2>();
  return s.x.tail<2>();
}

TargetMotion targetMotionFrom(core::Params& p)
{
  const std::string motion =
      p.choice("target_motion", {"differential-drive", "damped-velocity"}, "damped-velocity");
  if (motion == "differential-drive")
  {
    p.allowUnused({"target_velocity_std_mps", "target_velocity_time_s"});
    return DifferentialDriveTarget(DifferentialDriveTarget::Params::from(p));
  }
  p.allowUnused({"target_speed_mps", "target_speed_std_mps", "target_turn_rate_deg_per_s",
                 "target_turn_rate_std_deg_per_s", "target_speed_noise_mps",
                 "target_turn_rate_noise_deg_per_s", "target_speed_walk_mps_per_sqrt_s",
                 "target_turn_rate_walk_deg_per_s_per_sqrt_s"});
  return DampedVelocityTarget(DampedVelocityTarget::Params::from(p));
}
}  // namespace slamot::models
