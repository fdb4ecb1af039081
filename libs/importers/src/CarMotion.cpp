#include <slamot/importers/CarMotion.h>

namespace slamot::importers
{
namespace
{
double sinc(double a)
{
  return std::abs(a) < 1e-4 ? 1 - a * a / 6 : std::sin(a) / a;
}
}  // namespace

Gaussian<Pose2D> carArc(const CarGeometry& car, const CarNoise& noise, double wheelSpeed,
                        double steering, double dt)
{
  const double tangent = std::tan(steering);
  const double inner = car.wheelBase - car.wheelLeft * tangent;
  const double distance = wheelSpeed * dt * car.wheelBase / inner;
  const double turned = wheelSpeed * dt * tangent / inner;
  const double chord = distance * sinc(turned / 2);
  Gaussian<Pose2D> out;
  out.mean = {chord * std::cos(turned / 2), chord * std::sin(turned / 2), math::wrapToPi(turned)};

  // By speed, steering and slip, in the axes of the arc's middle, from which half of an error of
  // heading turns the chord.
  const double secant2 = 1 + tangent * tangent;
  const double turnBySteering = wheelSpeed * dt * secant2 * car.wheelBase / (inner * inner);
  Matrix3 J;
  J << distance, distance * secant2 * car.wheelLeft / inner, 0,        //
      turned * distance / 2, turnBySteering * distance / 2, distance,  //
      turned, turnBySteering, 0;
  const double driven = std::abs(distance);
  if (driven == 0) return out;
  const Vector3 std(noise.speed, noise.steering, noise.slip);
  const Matrix3 m = math::poseRotation(turned / 2) * J * std.asDiagonal();
  out.cov = (noise.length / driven) * (m * m.transpose());
  return out;
}

Gaussian<Pose2D> carriedTo(const Point2D& point_body, const Gaussian<Pose2D>& motion)
{
  const Pose2D point(point_body.x, point_body.y, 0);
  const double c = std::cos(motion.mean.phi), s = std::sin(motion.mean.phi);
  Matrix3 J = Matrix3::Identity();
  J(0, 2) = -s * point.x - c * point.y;
  J(1, 2) = c * point.x - s * point.y;
  Gaussian<Pose2D> out;
  out.mean = math::between(point, math::compose(motion.mean, point));
  const Matrix3 cov = J * motion.cov * J.transpose();
  out.cov = 0.5 * (cov + cov.transpose());
  return out;
}
}  // namespace slamot::importers
