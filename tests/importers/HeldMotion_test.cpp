#include <gtest/gtest.h>
#include <slamot/importers/HeldMotion.h>

namespace slamot::importers
{
namespace
{
Gaussian<Pose2D> increment(double dx, double dy, double dphi)
{
  Gaussian<Pose2D> out;
  out.mean = {dx, dy, dphi};
  out.cov << 0.04, 0.01, 0.002, 0.01, 0.09, -0.003, 0.002, -0.003, 0.01;
  return out;
}

const std::vector<HeldMotion>& motions()
{
  static const std::vector<HeldMotion> all = {
      HeldMotion::fromVelocities(2, 0.7, 0.4, 0.3, 0.1),
      HeldMotion::fromVelocities(-1, -9, 0.3, 0.4, 0.2),
      HeldMotion::fromVelocities(0, 0, 0.1, 0, 0),
      HeldMotion::fromIncrement(increment(1, 0.5, 0.8)),
      HeldMotion::fromIncrement(increment(-1, 0.2, -3.1)),
      HeldMotion::fromIncrement(increment(0.3, 0, 1e-9)),
  };
  return all;
}

TEST(HeldMotion, PartsComposeToTheWhole)
{
  for (const HeldMotion& motion : motions())
  {
    Gaussian<Pose2D> sum;
    const double cuts[] = {0, 0.1, 0.45, 0.46, 1};
    for (int i = 0; i < 4; ++i) sum = math::compose(sum, motion.part(cuts[i], cuts[i + 1]));
    const Gaussian<Pose2D>& whole = motion.whole();
    EXPECT_NEAR(sum.mean.x, whole.mean.x, 1e-12);
    EXPECT_NEAR(sum.mean.y, whole.mean.y, 1e-12);
    EXPECT_NEAR(math::wrapToPi(sum.mean.phi - whole.mean.phi), 0, 1e-12);
    EXPECT_LT((sum.cov - whole.cov).norm(), 1e-12) << sum.cov << "\n\n" << whole.cov;
  }
}

TEST(HeldMotion, PartsHaveNoNegativeVariance)
{
  for (const HeldMotion& motion : motions())
    for (const auto& [from, to] : {std::pair(0.0, 0.3), std::pair(0.3, 0.9), std::pair(0.9, 1.0)})
      EXPECT_GT(math::smallestEigenvalue(motion.part(from, to).cov), -1e-12);
}

TEST(HeldMotion, FirstPartTurnsFirstAtTheSameVelocities)
{
  const auto motion = HeldMotion::fromVelocities(2, 0.7, 0.4, 0.3, 0.1);
  // Half the time at the same velocities; half the variance is 1/sqrt(2) of the deviation over the
  // whole, so sqrt(2) times that of the velocity over the half.
  const auto half = math::turnThenMove(2, 0.7, 0.2, 0.3 * std::sqrt(2), 0);
  const auto part = HeldMotion::fromVelocities(2, 0.7, 0.4, 0.3, 0).part(0, 0.5);
  EXPECT_NEAR(part.mean.x, half.mean.x, 1e-12);
  EXPECT_NEAR(part.mean.y, half.mean.y, 1e-12);
  EXPECT_NEAR(part.mean.phi, 0.14, 1e-12);
  EXPECT_NEAR(motion.part(0.5, 1).mean.phi, 0.14, 1e-12);
  EXPECT_NEAR(part.cov.trace(), half.cov.trace(), 1e-12);
}

TEST(HeldMotion, IncrementIsCutOnItsArc)
{
  // A quarter of a circle of radius 2 to the left; its half is an eighth.
  const double quarter = math::kPi / 2;
  const auto motion = HeldMotion::fromIncrement(increment(2, 2, quarter));
  const Pose2D half = motion.part(0, 0.5).mean;
  EXPECT_NEAR(half.x, 2 * std::sin(quarter / 2), 1e-12);
  EXPECT_NEAR(half.y, 2 * (1 - std::cos(quarter / 2)), 1e-12);
  EXPECT_NEAR(half.phi, quarter / 2, 1e-12);
}
}  // namespace
}  // namespace slamot::importers
