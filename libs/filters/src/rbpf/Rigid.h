#pragma once

#include <slamot/math/gaussian.h>
#include <slamot/models/TargetState.h>

// Poses, points and targets moved as parts of one rigid body, `shift` its motion in map axes.  The
// identity changes no bit of them, but for angles that it wraps.
namespace slamot::filters::rbpf
{
inline Gaussian<Pose2D> moved(const Pose2D& shift, const Gaussian<Pose2D>& pose)
{
  const Matrix3 R = math::poseRotation(shift.phi);
  return {math::compose(shift, pose.mean), R * pose.cov * R.transpose()};
}

inline Gaussian<Point2D> moved(const Pose2D& shift, const Gaussian<Point2D>& point)
{
  const Matrix2 R = math::poseRotation(shift.phi).topLeftCorner<2, 2>();
  return {math::transform(shift, point.mean), R * point.cov * R.transpose()};
}

/// The motion that takes `from` to `to`.
inline Pose2D motionBetween(const Pose2D& from, const Pose2D& to)
{
  return math::compose(to, math::between(from, Pose2D(0, 0, 0)));
}

/// The rotation by `angle` of coordinates that come in pairs (x, y).
template <int N>
Eigen::Matrix<double, N, N> pairRotation(double angle)
{
  static_assert(N % 2 == 0);
  Eigen::Matrix<double, N, N> R = Eigen::Matrix<double, N, N>::Zero();
  for (int j = 0; j < N; j += 2)
    R.template block<2, 2>(j, j) = math::poseRotation(angle).topLeftCorner<2, 2>();
  return R;
}

/// A target's state.  `Motion` says which of its coordinates is a heading; without one, they are
/// pairs: place, velocity, acceleration.
template <class Motion>
typename Motion::State moved(const Pose2D& shift, const typename Motion::State& s)
{
  constexpr int N = Motion::State::kSize;
  typename Motion::State out = s;
  Eigen::Matrix<double, N, N> R = Eigen::Matrix<double, N, N>::Identity();
  if constexpr (Motion::kAngle < 0)
    R = pairRotation<N>(shift.phi);
  else
    R.template topLeftCorner<2, 2>() = pairRotation<2>(shift.phi);
  out.x = R * s.x;
  out.x[0] += shift.x;
  out.x[1] += shift.y;
  if constexpr (Motion::kAngle >= 0)
    out.x[Motion::kAngle] = math::wrapToPi(s.x[Motion::kAngle] + shift.phi);
  out.P = R * s.P * R.transpose();
  return out;
}

/// How a target's place, velocity and acceleration move with a small motion of the body, given as
/// the motion of its point `at` and its turn.
inline Eigen::Matrix<double, Eigen::Dynamic, 3> lever(const Eigen::VectorXd& kinematics,
                                                      const Point2D& at)
{
  Eigen::Matrix<double, Eigen::Dynamic, 3> T(kinematics.size(), 3);
  T.setZero();
  for (Eigen::Index j = 0; j + 1 < kinematics.size(); j += 2)
  {
    T(j, 2) = -kinematics[j + 1];
    T(j + 1, 2) = kinematics[j];
  }
  if (kinematics.size() == 0) return T;
  T(0, 0) = T(1, 1) = 1;
  T(0, 2) += at.y;
  T(1, 2) -= at.x;
  return T;
}
}  // namespace slamot::filters::rbpf
