#include <gtest/gtest.h>
#include <slamot/scans/returns.h>

#include <limits>

namespace slamot::scans
{
namespace
{
std::shared_ptr<core::LaserScan> scanOf(std::vector<float> ranges)
{
  auto scan = std::make_shared<core::LaserScan>();
  scan->angleStep = 0.1;
  scan->rangeMax = 50;
  scan->ranges = std::move(ranges);
  return scan;
}

TEST(ReturnsOf, LeavesOutWhatIsNoReturn)
{
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  constexpr float inf = std::numeric_limits<float>::infinity();
  const auto out = returnsOf({scanOf({nan, inf, -inf, -1, 0, 50, 31, 2})}, 30);
  ASSERT_EQ(out.size(), 1u);
  EXPECT_EQ(out[0].beam, 7u);
  EXPECT_NEAR(out[0].point.x, 2 * std::cos(0.7), 1e-12);
  EXPECT_NEAR(out[0].point.y, 2 * std::sin(0.7), 1e-12);
}

TEST(ReturnsOf, CountsBeamsOnOverAllLasers)
{
  auto rear = scanOf({3});
  rear->pose_robot_sensor = {-1, 0, math::kPi};
  const auto out = returnsOf({scanOf({1, 2}), scanOf({}), rear}, 30);
  ASSERT_EQ(out.size(), 3u);
  EXPECT_EQ(out[2].beam, 2u);
  EXPECT_NEAR(out[2].point.x, -4, 1e-12);
}

TEST(ReturnsOf, SurvivesGeometryThatMakesNoSense)
{
  auto scan = scanOf({1, 2});
  scan->pose_robot_sensor.x = 1e300;
  EXPECT_TRUE(returnsOf({scan}, 30).empty());
  scan = scanOf({1, 2});
  scan->angleStep = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(returnsOf({scan}, 30).empty());
  scan = scanOf({1, 2});
  scan->rangeMax = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(returnsOf({scan}, 30).empty());
}

TEST(Thinned, KeepsTheFirstPointOfEachSquare)
{
  const std::vector<Point2D> out =
      thinned({{0.01, 0.01}, {0.04, 0.04}, {-0.01, 0.01}, {0.06, 0.01}, {0.06, 0.02}}, 0.05);
  ASSERT_EQ(out.size(), 3u);
  EXPECT_EQ(out[0].x, 0.01);
  EXPECT_EQ(out[1].x, -0.01);
  EXPECT_EQ(out[2].y, 0.01);
}
}  // namespace
}  // namespace slamot::scans
