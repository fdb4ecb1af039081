#include <slamot/math/statistics.h>

#include <gtest/gtest.h>

#include "BoxFit.h"
#include "scene.h"

using namespace slamot;
using namespace slamot::moving;

namespace
{
using B = BoxState;

BoxState boxAt(const Pose2D& pose, double length, double width)
{
  BoxState s;
  s.x << pose.x, pose.y, pose.phi, 0, 0, length, width;
  return s;
}

/// What a laser at the origin sees of a box, exactly as the model has it.
BoxView viewOf(const BoxState& box, double std, std::uint64_t seed)
{
  moving::test::World world;
  moving::test::addBox(world, box.pose(), box.x[B::kLength], box.x[B::kWidth]);
  const core::LaserScan scan = moving::test::lookRound(world, {}, std, seed);
  perception::LaserOptions laser;
  const auto clusters = perception::clustersOf(scan, laser);
  BoxView view;
  for (const auto& c : clusters)  // a face that beams graze is torn off
    for (const auto& p : c.points) view.points.push_back(p.at);
  const double half = 0.5 * scan.angleStep;
  view.right = End{clusters.front().points.front().angle - half, half};
  view.left = End{clusters.back().points.back().angle + half, half};
  return view;
}

MovingOptions smooth()
{
  MovingOptions o;
  o.shapeStd = 0.005;
  o.laser.rangeStd = 0.02;
  return o;
}
}  // namespace

TEST(BoxBeams, ResidualsAreZeroWhereBoxAndViewAgree)
{
  for (const double phi : {-2.8, -1.0, 0.1, 0.6, 1.7})
  {
    const BoxState box = boxAt({2.0, 0.5, phi}, 0.8, 0.4);
    const BoxView view = viewOf(box, 0, 1);
    const auto residuals = residualsOf(box, view, smooth());
    ASSERT_GE(residuals.size(), 10u);
    for (std::size_t i = 0; i + 2 < residuals.size(); ++i)
      EXPECT_NEAR(residuals[i].value, 0, 1e-6) << "heading " << phi << ", return " << i;
    for (std::size_t i = residuals.size() - 2; i < residuals.size(); ++i)
      EXPECT_LE(std::abs(residuals[i].value), view.left->std + 1e-9) << "heading " << phi;
  }
}

TEST(BoxBeams, JacobiansAreThoseOfDifferences)
{
  const BoxState box = boxAt({2.0, 0.5, 0.6}, 0.8, 0.4);
  const BoxView view = viewOf(box, 0.01, 7);
  const auto at = residualsOf(box, view, smooth());
  constexpr double h = 1e-6;
  for (int i = 0; i < B::kSize; ++i)
  {
    BoxState up = box, down = box;
    up.x[i] += h, down.x[i] -= h;
    const auto high = residualsOf(up, view, smooth()), low = residualsOf(down, view, smooth());
    for (std::size_t k = 0; k < at.size(); ++k)
      EXPECT_NEAR(at[k].jacobian[i], (high[k].value - low[k].value) / (2 * h), 1e-5)
          << "coordinate " << i << ", residual " << k;
  }
}

TEST(BoxBeams, DistanceToTheOutlineIsFromOutsideAndInside)
{
  const BoxState box = boxAt({1, 1, math::kPi / 2}, 2, 1);
  EXPECT_NEAR(distanceToOutline(box, {1, 1}), 0.5, 1e-12);
  EXPECT_NEAR(distanceToOutline(box, {1, 3}), 1.0, 1e-12);
  EXPECT_NEAR(distanceToOutline(box, {1.5 + 0.3, 2.4}), 0.5, 1e-12);
  EXPECT_NEAR(distanceToOutline(box, {1.4, 1}), 0.1, 1e-12);
}

// Sides and place from one look at two faces, of a box of which little is known.
TEST(BoxFit, FindsTheBoxFromAVaguePrediction)
{
  for (const double phi : {0.5, 1.1, -0.6})
  {
    const BoxState truth = boxAt({1.8, 0.4, phi}, 0.7, 0.35);
    BoxState guess = truth;
    guess.x += (B::Vector() << 0.15, -0.12, 0.35, 0, 0, 0.2, -0.1).finished();
    guess.P.diagonal() << 0.04, 0.04, 0.2, 1, 1, 0.09, 0.04;
    const BoxState found = correct(guess, viewOf(truth, 0.005, 3), smooth());
    B::Vector error = found.x - truth.x;
    error[B::kPhi] = math::wrapToPi(error[B::kPhi]);
    for (const int i : {B::kX, B::kY, B::kPhi, B::kLength, B::kWidth})
    {
      const double std = std::sqrt(found.P(i, i));
      EXPECT_LT(std::abs(error[i]), 3 * std) << "heading " << phi << ", coordinate " << i;
      EXPECT_LT(std, std::sqrt(guess.P(i, i)) / 1.5) << "heading " << phi << ", coordinate " << i;
    }
  }
}

// A cluster's middle would be off by half the box's width.
TEST(BoxFit, OneFaceTellsThePlaceOfABoxWhoseWidthIsKnown)
{
  const BoxState truth = boxAt({0, 1.5, 0}, 0.7, 0.4);
  BoxState guess = truth;
  guess.x[B::kY] -= 0.2;
  guess.P.diagonal() << 0.04, 0.04, 0.01, 1, 1, 1e-4, 1e-4;
  const BoxState found = correct(guess, viewOf(truth, 0.005, 5), smooth());
  EXPECT_NEAR(found.x[B::kY], 1.5, 0.02);
  EXPECT_NEAR(found.x[B::kX], 0, 0.03);
}

// The prediction is drawn from its own covariance, so that both matter.
TEST(BoxFit, ItsCovarianceIsHonest)
{
  constexpr int kRuns = 400;
  double sum = 0;
  for (std::uint64_t seed = 1; seed <= kRuns; ++seed)
  {
    math::RandomStream random{seed, 77};
    const Pose2D at{random.uniform(1.0, 2.5), random.uniform(-1.0, 1.0),
                    random.uniform(-math::kPi, math::kPi)};
    const BoxState truth = boxAt(at, 0.7, 0.4);
    BoxState guess = truth;
    const B::Vector std = (B::Vector() << 0.08, 0.08, 0.15, 0.1, 0.1, 0.03, 0.03).finished();
    for (int i = 0; i < B::kSize; ++i) guess.x[i] += std[i] * random.normal();
    guess.P = std.cwiseAbs2().asDiagonal();
    const BoxState found = correct(guess, viewOf(truth, 0.02, seed), smooth());
    Vector3 e = found.x.head<3>() - truth.x.head<3>();
    e[2] = math::wrapToPi(e[2]);
    sum += math::mahalanobisSquared(e, found.P.topLeftCorner<3, 3>());
  }
  // Directions of ends are uniform within a beam, and taken for wider: below 1.
  const double nees = sum / (3 * kRuns);
  EXPECT_GT(nees, 0.5);
  EXPECT_LT(nees, 1.2);
}
