#pragma once

#include <slamot/math/gaussian.h>

namespace slamot::importers
{
/// A car with a speed encoder at its rear left wheel.  Its own frame is at the middle of the rear
/// axle, x ahead.
struct CarGeometry
{
  double wheelBase = 2.83;   ///< L, rear to front axle [m]
  double wheelLeft = 0.76;   ///< H, the encoder's wheel, left of the middle [m]
  Point2D mount{3.78, 0.5};  ///< the point whose path is wanted, in the car's own frame [m]
};

/// How far speed, steering and direction of driving err.  Each error lasts for `length`, and the
/// next is independent of it: random walks in the distance driven, however it is cut into steps,
/// and none at rest.
struct CarNoise
{
  double speed = 0;     ///< part of the speed
  double steering = 0;  ///< [rad]
  double slip = 0;      ///< [rad], between the direction of driving and the car's x axis
  double length = 1;    ///< [m]
};

/// The motion of the middle of the rear axle while speed and steering are held: an arc, exactly.
/// The axle's speed is v / (1 - tan(steering) H / L): the encoder's wheel runs on another radius.
/// \param wheelSpeed v, of the encoder's wheel [m/s]
/// \param steering [rad], positive to the left, below 1 in size
/// \param dt [s]
[[nodiscard]] Gaussian<Pose2D> carArc(const CarGeometry& car, const CarNoise& noise,
                                      double wheelSpeed, double steering, double dt);

/// The motion of another point of the same rigid body, in that point's frame, whose axes are
/// parallel to the body's: the mean exactly, the covariance by its Jacobian.
[[nodiscard]] Gaussian<Pose2D> carriedTo(const Point2D& point_body, const Gaussian<Pose2D>& motion);
}  // namespace slamot::importers
