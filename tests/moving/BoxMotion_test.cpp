#include <gtest/gtest.h>

#include "BoxState.h"

using namespace slamot;
using namespace slamot::moving;

namespace
{
using B = BoxState;

BoxState someBox()
{
  BoxState s;
  s.x << 1.0, -2.0, 0.7, 1.3, 0.9, 0.5, 0.3;
  const B::Matrix A =
      (B::Matrix() << B::Matrix::Identity() * 0.2).finished() + 0.02 * B::Matrix::Ones();
  s.P = A * A.transpose();
  return s;
}

MovingOptions noiseless()
{
  MovingOptions o;
  o.speedWalk = o.turnWalk = o.slide = 0;
  o.axleBehind = 0.17;
  return o;
}

B::Matrix numericJacobian(const BoxState& s, double dt, const MovingOptions& o)
{
  constexpr double h = 1e-6;
  B::Matrix out;
  for (int i = 0; i < B::kSize; ++i)
  {
    BoxState up = s, down = s;
    up.x[i] += h, down.x[i] -= h;
    predict(up, dt, o), predict(down, dt, o);
    out.col(i) = (up.x - down.x) / (2 * h);
  }
  return out;
}
}  // namespace

TEST(BoxMotion, CovarianceFollowsTheNumericJacobian)
{
  const BoxState before = someBox();
  const B::Matrix F = numericJacobian(before, 0.3, noiseless());
  BoxState after = before;
  predict(after, 0.3, noiseless());
  EXPECT_LT((after.P - F * before.P * F.transpose()).cwiseAbs().maxCoeff(), 1e-8);
}

TEST(BoxMotion, TheAxleDoesNotSlide)
{
  BoxState s = someBox();
  const MovingOptions o = noiseless();
  const auto axle = [&] { return pointOf(s, -o.axleBehind, o).pose.mean; };
  for (int i = 0; i < 50; ++i)
  {
    const Pose2D before = axle();
    predict(s, 0.01, o);
    const Pose2D went = math::between(before, axle());
    EXPECT_NEAR(went.x, 1.3 * 0.01, 1e-5);
    EXPECT_NEAR(went.y, 0.5 * went.x * went.phi, 1e-6);  // an arc's chord, no more
  }
}

TEST(BoxMotion, TwoHalfStepsSpreadAsMuchAsOneWhereThePathIsStraight)
{
  MovingOptions o = noiseless();
  o.speedWalk = 0.8, o.slide = 0.1;
  BoxState one = someBox();
  one.x[B::kTurn] = 0;
  one.P.row(B::kTurn).setZero(), one.P.col(B::kTurn).setZero();
  BoxState two = one;
  predict(one, 0.4, o);
  predict(two, 0.2, o), predict(two, 0.2, o);
  EXPECT_LT((one.P - two.P).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(BoxMotion, VelocityOfAPointIsItsDisplacementByTime)
{
  const BoxState s = someBox();
  const MovingOptions o = noiseless();
  BoxState later = s;
  constexpr double dt = 1e-5;
  predict(later, dt, o);
  const BoxPoint a = pointOf(s, 0.11, o), b = pointOf(later, 0.11, o);
  EXPECT_NEAR(a.velocity[0], (b.pose.mean.x - a.pose.mean.x) / dt, 1e-4);
  EXPECT_NEAR(a.velocity[1], (b.pose.mean.y - a.pose.mean.y) / dt, 1e-4);
}
