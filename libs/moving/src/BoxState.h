#pragma once

#include <slamot/math/gaussian.h>
#include <slamot/moving/MovingOptions.h>

namespace slamot::moving
{
/// A rectangle that drives: its middle (x, y) [m], heading [rad], speed [m/s] along it, turn rate
/// [rad/s], length and width [m]; covariance in these coordinates.
struct BoxState
{
  enum
  {
    kX,
    kY,
    kPhi,
    kSpeed,
    kTurn,
    kLength,
    kWidth,
    kSize
  };
  using Vector = Eigen::Matrix<double, kSize, 1>;
  using Matrix = Eigen::Matrix<double, kSize, kSize>;

  Vector x = Vector::Zero();
  Matrix P = Matrix::Zero();

  [[nodiscard]] Pose2D pose() const { return {x[kX], x[kY], x[kPhi]}; }
};

/// The state dt [s] later: the point on the axle follows an arc, speed and turn rate walk.
void predict(BoxState& s, double dt, const MovingOptions& options);

/// Where a point of the box's axis, `ahead` [m] of its middle, is; its velocity [m/s], and their
/// covariances, both in the state's axes.
struct BoxPoint
{
  Gaussian<Pose2D> pose;
  Vector2 velocity;
  Matrix2 velocityCov;
};
[[nodiscard]] BoxPoint pointOf(const BoxState& s, double ahead, const MovingOptions& options);
}  // namespace slamot::moving
