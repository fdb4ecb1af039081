#include <gtest/gtest.h>
#include <slamot/importers/CarMotion.h>

namespace slamot::importers
{
namespace
{
const CarGeometry kCar;

/// The car's path over n equal steps, of the middle of its rear axle.
Gaussian<Pose2D> drive(double speed, double steering, double duration, int n,
                       const CarNoise& noise = {})
{
  Gaussian<Pose2D> sum;
  for (int i = 0; i < n; ++i)
    sum = math::compose(sum, carArc(kCar, noise, speed, steering, duration / n));
  return sum;
}

void expectNear(const Pose2D& a, const Pose2D& b, double tolerance)
{
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(math::wrapToPi(a.phi - b.phi), 0, tolerance);
}

TEST(CarMotion, StraightOnEveryPointMovesAlike)
{
  const auto axle = drive(2, 0, 1.5, 7);
  expectNear(axle.mean, {3, 0, 0}, 1e-12);
  expectNear(carriedTo(kCar.mount, axle).mean, {3, 0, 0}, 1e-12);
  expectNear(drive(-2, 0, 1.5, 7).mean, {-3, 0, 0}, 1e-12);
}

TEST(CarMotion, SteeredAllPointsCircleRoundOneCentre)
{
  for (const double steering : {0.3, -0.5, 0.02, -1e-7})
    for (const double speed : {1.7, -0.8})
    {
      // The centre lies on the rear axle's line, and the encoder's wheel is H nearer to it.
      const double radius = kCar.wheelBase / std::tan(steering);
      const double turned = speed * 2.0 / (radius - kCar.wheelLeft);
      const Pose2D centre(0, radius, 0);
      const auto onCircle = [&](const Point2D& p)
      {
        const Point2D from(p.x, p.y - radius);
        const Point2D to = math::transform({0, radius, turned}, from);
        return Pose2D(to.x, to.y, turned);
      };
      const double tolerance = std::abs(radius) > 1e4 ? 1e-6 : 1e-11;
      for (const int n : {1, 80})
      {
        const auto axle = drive(speed, steering, 2, n);
        expectNear(axle.mean, onCircle({0, 0}), tolerance);
        const Pose2D mount(kCar.mount.x, kCar.mount.y, 0);
        expectNear(math::compose(mount, carriedTo(kCar.mount, axle).mean), onCircle(kCar.mount),
                   tolerance);
        // The wheel with the encoder covers what it says.
        const double wheel = std::abs(radius - kCar.wheelLeft) * std::abs(turned);
        EXPECT_NEAR(wheel, std::abs(speed) * 2, 1e-9);
      }
    }
}

TEST(CarMotion, CarryingStepByStepIsCarryingTheWhole)
{
  const CarNoise noise{0.1, 0.05, 0.02, 1};
  const auto a = carArc(kCar, noise, 3, 0.4, 0.5), b = carArc(kCar, noise, 2, -0.2, 0.7);
  const auto whole = carriedTo(kCar.mount, math::compose(a, b));
  const auto parts = math::compose(carriedTo(kCar.mount, a), carriedTo(kCar.mount, b));
  expectNear(whole.mean, parts.mean, 1e-12);
  EXPECT_LT((whole.cov - parts.cov).norm(), 1e-12);
}

TEST(CarMotion, CovarianceIsThatOfDisturbedSpeedAndSteering)
{
  const double speed = 3, steering = 0.4, dt = 0.025, h = 1e-5;
  const double driven = drive(speed, steering, dt, 1).mean.norm();
  const auto at = [&](double v, double s)
  { return carriedTo(kCar.mount, carArc(kCar, {}, v, s, dt)).mean; };
  const auto slope = [&](const Pose2D& hi, const Pose2D& lo) {
    return Vector3((hi.x - lo.x) / (2 * h), (hi.y - lo.y) / (2 * h), (hi.phi - lo.phi) / (2 * h));
  };
  const auto check = [&](const CarNoise& noise, const Vector3& byError)
  {
    const Matrix3 expected = byError * byError.transpose() / driven;
    const Matrix3 cov = carriedTo(kCar.mount, carArc(kCar, noise, speed, steering, dt)).cov;
    EXPECT_LT((cov - expected).norm(), 1e-3 * expected.norm()) << cov << "\n\n" << expected;
  };
  check({1, 0, 0, 1}, slope(at(speed * (1 + h), steering), at(speed * (1 - h), steering)));
  check({0, 1, 0, 1}, slope(at(speed, steering + h), at(speed, steering - h)));
  const double half = at(speed, steering).phi / 2;
  check({0, 0, 1, 1}, math::poseRotation(half) * Vector3(0, driven, 0));
}

TEST(CarMotion, UncertaintyGrowsWithTheDistanceWhateverTheSteps)
{
  const CarNoise noise{0.03, 0.02, 0.01, 2.5};
  for (const double speed : {0.5, -4.0})
    for (const int n : {200, 1000})
    {
      const Matrix3 cov = drive(speed, 0, 20 / std::abs(speed), n, noise).cov;
      const double perMetre = std::pow(0.02 / kCar.wheelBase, 2) * 2.5;
      EXPECT_NEAR(cov(2, 2), 20 * perMetre, 1e-12);
      // By speed, and by steering through the encoder's wheel.
      const double along = 0.03 * 0.03 + std::pow(0.02 * kCar.wheelLeft / kCar.wheelBase, 2);
      EXPECT_NEAR(cov(0, 0), 20 * 2.5 * along, 1e-9);
      // The integral of a random walk of heading, and slip.
      EXPECT_NEAR(cov(1, 1), 8000 * perMetre / 3 + 20 * 2.5 * 0.0001, 1e-4 * cov(1, 1));
    }
}

TEST(CarMotion, AtRestNothingIsUncertain)
{
  const auto rest = carriedTo(kCar.mount, carArc(kCar, {0.1, 0.1, 0.1, 1}, 0, 0.3, 10));
  expectNear(rest.mean, {}, 0);
  EXPECT_TRUE(rest.cov.isZero(0));
}
}  // namespace
}  // namespace slamot::importers
