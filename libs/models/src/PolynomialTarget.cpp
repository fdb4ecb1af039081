#include <slamot/models/PolynomialTarget.h>

#include <cmath>

#include "headingOf.h"

namespace slamot::models
{
using Start = core::ObjectStart;

template <int Order>
typename PolynomialTarget<Order>::Params PolynomialTarget<Order>::Params::from(core::Params& p)
{
  Params out{p.positive("target_velocity_std_mps"), 0, 0};
  if constexpr (Order == 2)
  {
    out.accelerationStd = p.positive("target_acceleration_std_mps2");
    out.noise = p.nonNegative("target_jerk_noise_mps3_per_sqrt_hz");
  }
  else
  {
    const char* stepwise = "target_step_acceleration_std_mps2";
    const auto otherwise = p.has(stepwise) ? std::optional(0.0) : std::nullopt;
    out.noise = p.nonNegative("target_acceleration_noise_mps2_per_sqrt_hz", otherwise);
    out.stepAccelerationStd = p.nonNegative(stepwise, 0.0);
  }
  return out;
}

template <int Order>
typename PolynomialTarget<Order>::State PolynomialTarget<Order>::start(const Start& start) const
{
  State s;
  const double otherwise[] = {0, params_.velocityStd, params_.accelerationStd};
  constexpr Start::Field fields[] = {Start::kX,  Start::kY,  Start::kVx,
                                     Start::kVy, Start::kAx, Start::kAy};
  for (int i = 0; i < kSize; ++i)
  {
    const Start::Field f = fields[i];
    s.x[i] = start.get(f);
    s.P(i, i) = std::pow(start.value[f] ? start.getStd(f) : otherwise[i / 2], 2);
  }
  return s;
}

template <int Order>
typename PolynomialTarget<Order>::State PolynomialTarget<Order>::birth(
    const Gaussian<Point2D>& place) const
{
  State s;
  s.x.template head<2>() << place.mean.x, place.mean.y;
  s.P.template topLeftCorner<2, 2>() = place.cov;
  s.P(2, 2) = s.P(3, 3) = params_.velocityStd * params_.velocityStd;
  if constexpr (Order == 2)
    s.P(4, 4) = s.P(5, 5) = params_.accelerationStd * params_.accelerationStd;
  return s;
}

template <int Order>
TargetTransition<PolynomialTarget<Order>::kSize> PolynomialTarget<Order>::transition(
    double dt) const
{
  // Derivatives i and j of the place both integrate the noise, Order - i and Order - j times over.
  constexpr double factorial[] = {1, 1, 2};
  TargetTransition<kSize> out;
  for (int i = 0; i <= Order; ++i)
    for (int j = 0; j <= Order; ++j)
    {
      const int a = Order - i, b = Order - j;
      const double q = params_.noise * params_.noise * std::pow(dt, a + b + 1) /
                       ((a + b + 1) * factorial[a] * factorial[b]);
      out.Q.template block<2, 2>(2 * i, 2 * j).diagonal().setConstant(q);
      if (j > i)
        out.F.template block<2, 2>(2 * i, 2 * j)
            .diagonal()
            .setConstant(std::pow(dt, j - i) / factorial[j - i]);
    }
  if constexpr (Order == 1)
  {
    Eigen::Matrix<double, kSize, 2> G;  // of the state by the step's acceleration
    G << 0.5 * dt * dt * Matrix2::Identity(), dt * Matrix2::Identity();
    out.Q += std::pow(params_.stepAccelerationStd, 2) * G * G.transpose();
  }
  return out;
}

template <int Order>
TargetTransition<PolynomialTarget<Order>::kSize> PolynomialTarget<Order>::move(State& s,
                                                                               double dt) const
{
  const auto t = transition(dt);
  s.x = (t.F * s.x).eval();
  return t;
}

template <int Order>
Gaussian<Pose2D> PolynomialTarget<Order>::pose(const State& s)
{
  return poseOf(s.point(), s.pointCov(), s.x.template segment<2>(2),
                s.P.template block<2, 2>(2, 2));
}

template <int Order>
Vector2 PolynomialTarget<Order>::velocity(const State& s, Matrix2& cov)
{
  cov = s.P.template block<2, 2>(2, 2);
  return s.x.template segment<2>(2);
}

template <int Order>
Kinematics<PolynomialTarget<Order>::kSize, PolynomialTarget<Order>::kSize>
PolynomialTarget<Order>::kinematics(const State& s)
{
  return {s.x, Eigen::Matrix<double, kSize, kSize>::Identity()};
}

template <int Order>
void PolynomialTarget<Order>::widen(State& s, const Matrix3& poseCov)
{
  Eigen::Matrix<double, kSize, 3> G = Eigen::Matrix<double, kSize, 3>::Zero();
  G.template topLeftCorner<2, 2>().setIdentity();
  for (int i = 2; i < kSize; i += 2)  // a turn turns velocity and acceleration
  {
    G(i, 2) = -s.x[i + 1];
    G(i + 1, 2) = s.x[i];
  }
  s.P += G * poseCov * G.transpose();
}

template class PolynomialTarget<1>;
template class PolynomialTarget<2>;
}  // namespace slamot::models
