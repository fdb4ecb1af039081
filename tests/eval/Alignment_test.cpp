#include <gtest/gtest.h>
#include <slamot/eval/Alignment.h>
#include <slamot/math/random.h>

#include <stdexcept>

#include "testRuns.h"

namespace slamot::eval
{
namespace
{
double squaredDistance(const Pose2D& t, const std::vector<Point2D>& a,
                       const std::vector<Point2D>& b)
{
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (math::transform(t, a[i]) - b[i]).sqrNorm();
  return sum;
}
}  // namespace

TEST(RigidAlignment, FindsTheMotionExactly)
{
  math::RandomStream random{4};
  for (int trial = 0; trial < 50; ++trial)
  {
    const Pose2D motion(random.uniform(-9, 9), random.uniform(-9, 9), random.uniform(-3, 3));
    std::vector<Point2D> a, b;
    for (int i = 0; i < 2 + trial % 5; ++i)
    {
      a.emplace_back(random.uniform(-5, 5), random.uniform(-5, 5));
      b.push_back(math::transform(motion, a.back()));
    }
    const Pose2D found = rigidAlignment(a, b);
    EXPECT_NEAR(found.x, motion.x, 1e-9);
    EXPECT_NEAR(found.y, motion.y, 1e-9);
    EXPECT_NEAR(math::wrapToPi(found.phi - motion.phi), 0, 1e-9);
  }
}

TEST(RigidAlignment, IsTheLeastOfAllMotionsNearby)
{
  math::RandomStream random{5};
  std::vector<Point2D> a, b;
  for (int i = 0; i < 20; ++i)
  {
    a.emplace_back(random.uniform(-5, 5), random.uniform(-5, 5));
    b.emplace_back(a.back().y + 0.3 * random.normal(), -a.back().x + 0.3 * random.normal());
  }
  const Pose2D best = rigidAlignment(a, b);
  for (const double d : {-1e-3, 1e-3})
    for (const Pose2D& off : {Pose2D(d, 0, 0), Pose2D(0, d, 0), Pose2D(0, 0, d)})
      EXPECT_LT(squaredDistance(best, a, b),
                squaredDistance({best.x + off.x, best.y + off.y, best.phi + off.phi}, a, b));
}

TEST(RigidAlignment, NeedsAsManyPointsOnBothSides)
{
  EXPECT_THROW((void)rigidAlignment({{0, 0}}, {}), std::invalid_argument);
  EXPECT_THROW((void)rigidAlignment({}, {}), std::invalid_argument);
}

TEST(Alignment, FirstPoseBringsTheFirstPosesTogether)
{
  PerfectRun run(10);
  run.moveMap({3, -2, 1.1});
  const auto t = alignment({{&run.record, &run.truth}}, Align::kFirstPose, 2.0);
  ASSERT_TRUE(t);
  const Pose2D first = math::compose(*t, run.record.rows[0].robot.mean);
  EXPECT_NEAR(first.x, run.truth.robot.poses[0].pose.x, 1e-12);
  EXPECT_NEAR(first.y, run.truth.robot.poses[0].pose.y, 1e-12);
  EXPECT_NEAR(first.phi, run.truth.robot.poses[0].pose.phi, 1e-12);
}

TEST(Alignment, OfSeveralRobotsIsOneForAll)
{
  PerfectRun a(10), b(12);
  for (auto& p : b.truth.robot.poses) p.pose = math::compose({4, 4, 2}, p.pose);
  for (auto& r : b.record.rows) r.robot.mean = math::compose({4, 4, 2}, r.robot.mean);
  const Pose2D motion(3, -2, 1.1);
  a.moveMap(motion);
  b.moveMap(motion);
  const auto t = alignment({{&a.record, &a.truth}, {&b.record, &b.truth}}, Align::kRigid, 2.0);
  ASSERT_TRUE(t);
  const Pose2D undone = math::compose(*t, motion);
  EXPECT_NEAR(undone.x, 0, 1e-9);
  EXPECT_NEAR(undone.y, 0, 1e-9);
  EXPECT_NEAR(undone.phi, 0, 1e-9);
}

TEST(Alignment, IsNoneWhereTimesHaveNothingInCommon)
{
  PerfectRun run(10);
  for (auto& row : run.record.rows) row.time += 100;
  EXPECT_FALSE(alignment({{&run.record, &run.truth}}, Align::kRigid, 2.0));
  EXPECT_FALSE(alignment({{&run.record, &run.truth}}, Align::kFirstPose, 2.0));
}
}  // namespace slamot::eval
