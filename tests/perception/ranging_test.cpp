#include <slamot/perception/ranging.h>

#include "castScans.h"

#include <gtest/gtest.h>
#include <slamot/math/gaussian.h>

namespace slamot::perception
{
namespace
{
using namespace test;

const Point2D kCamera{0.2, -0.1};

Gaze gazeAt(const Point2D& what, double std = 0.01)
{
  return {kCamera, std::atan2(what.y - kCamera.y, what.x - kCamera.x), std};
}

std::vector<RangedObject> objects(const Gaze& gaze, const core::LaserScan& scan,
                                  const Pose2D& robot_image_scan = {},
                                  const RangingOptions& options = {})
{
  const LaserOptions laser;
  return objectsSeen(gaze, robot_image_scan, scan, clustersOf(scan, laser), laser, options);
}

TEST(ObjectsSeen, RangeTheThingThatTheCameraLooksAt)
{
  double sum = 0;
  constexpr int kScans = 200;
  for (std::uint64_t seed = 1; seed <= kScans; ++seed)
  {
    math::RandomStream random{seed};
    const Point2D at{random.uniform(1.5, 6), random.uniform(-1, 1)};
    const Point2D other{at.x, at.y + 1.5};  // as large, elsewhere
    const World world{{{at, 0.2}, {other, 0.2}}, {{{9, -9}, {9, 9}}}};
    Gaze gaze = gazeAt(at, 0.02);
    gaze.bearing += 0.02 * random.normal();
    const auto seen = objects(gaze, scanOf(world, {}, seed));
    ASSERT_EQ(seen.size(), 1u) << seed;
    const Vector2 e(seen[0].center.mean.x - at.x, seen[0].center.mean.y - at.y);
    EXPECT_LT(e.norm(), 0.25) << seed;
    EXPECT_NEAR(seen[0].range, std::hypot(at.x - kCamera.x, at.y - kCamera.y), 0.25);
    sum += math::mahalanobisSquared(e, seen[0].center.cov);
  }
  EXPECT_LT(sum / kScans, 2.6);
}

TEST(ObjectsSeen, NothingInReachIsNothing)
{
  const World world{{{{3, 2}, 0.2}, {{3, 0}, 0.9}}, {}};
  EXPECT_TRUE(objects(gazeAt({3, 0}), scanOf(world, {}, 1)).empty());  // too large for it
  EXPECT_TRUE(objects(gazeAt({3, -2}), scanOf(world, {}, 1)).empty());
  EXPECT_TRUE(objects(gazeAt({3, 0}), core::LaserScan{}).empty());
}

TEST(ObjectsSeen, AllThatItMayBeNearestFirst)
{
  // The camera sees past the nearer one, over which it stands beside the laser.
  const World world{{{{5, 0.35}, 0.2}, {{3, -0.1}, 0.15}}, {}};
  const auto seen = objects(gazeAt({4, 0.06}, 0.1), scanOf(world, {}, 2));
  ASSERT_EQ(seen.size(), 2u);
  EXPECT_LT(seen[0].range, seen[1].range);
  EXPECT_NEAR(seen[0].center.mean.x, 3, 0.25);
}

// The robot drives and turns between scan and image; odometry says how.
TEST(ObjectsSeen, TheMotionBetweenScanAndImageIsTakenOut)
{
  const Pose2D robot_image_scan{-0.4, 0.05, -0.3};
  const Point2D atImage{4, 0.5};
  const Point2D atScan = math::transform(math::between(robot_image_scan, {0, 0, 0}), atImage);
  const auto scan = scanOf({{{atScan, 0.2}}, {}}, {}, 3);
  const auto seen = objects(gazeAt(atImage), scan, robot_image_scan);
  ASSERT_EQ(seen.size(), 1u);
  EXPECT_NEAR(seen[0].center.mean.x, atImage.x, 0.1);
  EXPECT_NEAR(seen[0].center.mean.y, atImage.y, 0.1);
  EXPECT_TRUE(objects(gazeAt(atImage), scan).empty());
}
}  // namespace
}  // namespace slamot::perception
