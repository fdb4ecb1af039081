#pragma once

#include <slamot/core/Team.h>
#include <slamot/models/TargetMotion.h>

#include <cmath>

namespace slamot::filters
{
/// core::TeamFilter::predictTarget() by a target's model: what it does not know is left out.
template <class Motion>
void predictKinematics(const Motion& motion, core::RobotAndTarget& other, double dt)
{
  using Kinematics = decltype(Motion::kinematics(typename Motion::State{}));
  constexpr int K = decltype(Kinematics::value)::RowsAtCompileTime;
  constexpr int kRobot = core::RobotAndTarget::kRobot;
  if (other.targetSize() > K)
  {
    other.mean.conservativeResize(kRobot + K);
    other.cov.conservativeResize(kRobot + K, kRobot + K);
  }
  const int k = other.targetSize();
  if (k == 0 || dt <= 0) return;
  Eigen::Matrix<double, K, 1> x = Eigen::Matrix<double, K, 1>::Zero();
  x.head(k) = other.mean.tail(k);
  const models::TargetTransition<K> t = motion.kinematicTransition(x, dt);
  Eigen::MatrixXd Q = t.Q.topLeftCorner(k, k);
  if constexpr (K == 6)  // an acceleration that was not told is noise
    if (k < K)
      Q += std::pow(motion.accelerationStd(), 2) * t.F.template block<4, 2>(0, 4) *
           t.F.template block<4, 2>(0, 4).transpose();
  Eigen::MatrixXd F = Eigen::MatrixXd::Identity(kRobot + k, kRobot + k);
  F.bottomRightCorner(k, k) = t.F.topLeftCorner(k, k);
  other.mean = (F * other.mean).eval();
  other.cov = (F * other.cov * F.transpose()).eval();
  other.cov.bottomRightCorner(k, k) += Q;
  other.cov = (0.5 * (other.cov + other.cov.transpose())).eval();
  other.time += dt;
}
}  // namespace slamot::filters
