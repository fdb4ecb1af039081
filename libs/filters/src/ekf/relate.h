#pragma once

#include "Belief.h"
#include "sighting/soften.h"

namespace slamot::filters::ekf
{
/// Innovation of a sighting of the object that begins at `object`, by a robot; S from all their
/// covariances.  `noise` multiplies the sighting's variances.  False as innovate().
inline bool relate(const Belief& belief, int robot, int object, const Eye& eye, const Ray& z,
                   Innovation& o, double noise = 1)
{
  const Matrix3 R = belief.P().block<3, 3>(robot, robot);
  const Matrix2 M = belief.P().block<2, 2>(object, object);
  const Eigen::Matrix<double, 2, 3> MR = belief.P().block<2, 3>(object, robot);
  const Matrix2 across = MR.leftCols<2>();
  const Matrix2 D = M + R.topLeftCorner<2, 2>() - across - across.transpose();
  const auto& x = belief.x();
  if (!innovate(eye, z, x[object], x[object + 1], D(0, 0), D(0, 1), D(1, 1), o, noise))
    return false;
  // What is left of S is due to the heading.
  const Vector2 turn(o.turnR, o.turnB);
  Matrix2 H;
  H << o.h11, o.h12, o.h21, o.h22;
  const Vector2 withHeading = H * (MR.col(2) - R.block<2, 1>(0, 2));
  const Matrix2 add = turn * withHeading.transpose() + withHeading * turn.transpose() +
                      R(2, 2) * turn * turn.transpose();
  o.s11 += add(0, 0);
  o.s12 += add(0, 1);
  o.s22 += add(1, 1);
  o.det = o.s11 * o.s22 - o.s12 * o.s12;
  o.d2 = o.form();
  soften(z, noise, nullptr, o);
  return true;
}

/// The same sighting for an update.
inline SightingRows rowsOf(int robot, int object, const Innovation& o, const Ray& z,
                           double noise = 1)
{
  SightingRows out;
  out.robot = robot;
  out.object = object;
  out.byRobot << -o.h11, -o.h12, o.turnR, -o.h21, -o.h22, o.turnB;
  out.byObject << o.h11, o.h12, o.h21, o.h22;
  out.innovation << o.nuR, o.nuB;
  out.variance << (z.hasRange ? noise : 1) * z.varRange, noise * z.varBearing;
  out.law = z.law;
  out.hasRange = z.hasRange;
  out.factor = o.factor;
  return out;
}

/// Whether a sighting is taken in the frame of its ray: in polar coordinates a turn of the robot
/// moves the bearing alone, by as much.
inline bool isClose(const SightingRows& row)
{
  return row.byRobot(0, 2) != 0 || row.byRobot(1, 2) != -1;
}

/// The rows' derivatives as if the landmark were where it was first thought to be.  Derivatives at
/// ever new estimates make the filter believe that it learns of its heading in the map what no
/// sighting can tell; at first estimates, what can't be observed stays so: Huang, Mourikis,
/// Roumeliotis 2008.
inline void deriveAt(const Point2D& first, const Eye& eye, SightingRows& row)
{
  const Vector2 d(first.x - eye.x, first.y - eye.y);
  if (isClose(row))
  {
    const double perMetre = row.byObject.row(1).norm();
    const Vector2 inFrame = row.byObject * d;
    row.byRobot.col(2) << inFrame[1] / perMetre, -inFrame[0] * perMetre;
    return;
  }
  const double q = d.squaredNorm(), r = std::sqrt(q);
  constexpr double kMin = models::RangeBearing::kSmallestRange;
  if (!(r >= kMin)) return;
  row.byObject << d[0] / r, d[1] / r, -d[1] / q, d[0] / q;
  row.byRobot.leftCols<2>() = -row.byObject;
}

/// A robot's pose with sine and cosine of its heading.
inline Eye eyeOf(const Belief& belief, int robot)
{
  const auto& x = belief.x();
  return Eye(Pose2D(x[robot], x[robot + 1], x[robot + 2]));
}

/// Derivative, by the robot's pose, of the place where a sighting puts its object.
inline Eigen::Matrix<double, 2, 3> placeByRobot(const Eye& eye, const Point2D& place)
{
  Eigen::Matrix<double, 2, 3> out;
  out << 1, 0, eye.y - place.y, 0, 1, place.x - eye.x;
  return out;
}
}  // namespace slamot::filters::ekf
