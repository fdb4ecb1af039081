#include <slamot/eval/ScanMap.h>

#include <gtest/gtest.h>
#include <slamot/math/random.h>

#include <limits>

namespace slamot::eval
{
namespace
{
std::vector<Point2D> wall(double blur, std::uint64_t seed)
{
  math::RandomStream random{seed};
  std::vector<Point2D> out;
  for (int i = 0; i < 4000; ++i)
    out.push_back({random.uniform(-10, 10), 3 + blur * random.normal()});
  return out;
}

/// A robot that sees one wall ahead of it, 4 m off, and something round at 2 m.
Record drive(double drift)
{
  Record record;
  auto scan = std::make_shared<core::LaserScan>();
  scan->angleMin = -0.5;
  scan->angleStep = 0.01;
  scan->rangeMax = 30;
  for (int i = 0; i <= 100; ++i)
  {
    const double a = -0.5 + 0.01 * i;
    scan->ranges.push_back(static_cast<float>(std::abs(a) < 0.05 ? 2 : 4 / std::cos(a)));
  }
  for (std::size_t i = 0; i < 20; ++i)
  {
    RobotRow row;
    row.time = static_cast<double>(i);
    row.odometry = {drift * static_cast<double>(i), 0, 0};
    record.rows.push_back(row);
    record.lasers.push_back({i, scan});
  }
  return record;
}
}  // namespace

// Along a straight wall neighbours are uniform over 2 r, across it normal: the entropy has a closed
// form but for the ends.
TEST(MeanMapEntropy, IsThatOfAGaussianWall)
{
  for (const double blur : {0.01, 0.03})
  {
    const double along = 0.3 * 0.3 / 3, across = blur * blur + 1e-4;
    const double expected = std::log(2 * math::kPi) + 1 + 0.5 * std::log((along + 1e-4) * across);
    const auto entropy = meanMapEntropy(wall(blur, 1));
    ASSERT_TRUE(entropy);
    EXPECT_NEAR(*entropy, expected, 0.05) << blur;
  }
}

TEST(MeanMapEntropy, IsLessTheSharperTheMapAndTheSameWhereverItLies)
{
  EXPECT_LT(*meanMapEntropy(wall(0.01, 1)), *meanMapEntropy(wall(0.05, 1)) - 0.5);
  auto moved = wall(0.02, 2);
  for (Point2D& p : moved) p = math::transform({-500, 321, 2}, p);
  EXPECT_NEAR(*meanMapEntropy(moved), *meanMapEntropy(wall(0.02, 2)), 1e-9);
}

TEST(MeanMapEntropy, LonePointsHaveNone)
{
  EXPECT_FALSE(meanMapEntropy({}));
  EXPECT_FALSE(meanMapEntropy({{0, 0}, {1, 1}, {5, 5}}));
}

TEST(ScanMapQuality, TellsAPathFromDriftingOdometry)
{
  EXPECT_FALSE(scanMapQuality(Record{}));
  const auto still = scanMapQuality(drive(0)), drifting = scanMapQuality(drive(0.05));
  EXPECT_EQ(still->points, 20u * 101);
  EXPECT_EQ(*still->entropy, *still->odometryEntropy);
  EXPECT_LT(*drifting->entropy, *drifting->odometryEntropy - 0.5);
  Record untold = drive(0);
  untold.hasOdometry = false;
  EXPECT_FALSE(scanMapQuality(untold)->odometryEntropy);
}

// A filter that drifted, and mended its path at the end.
TEST(ScanMapQuality, TellsTheFinalPathFromTheEstimates)
{
  Record record = drive(0);
  for (RobotRow& row : record.rows) row.robot.mean.x = 0.05 * row.time;
  EXPECT_FALSE(scanMapQuality(record)->pathEntropy) << "the filter keeps none";
  EXPECT_TRUE(scanPoints(record, PosesOf::kPath).empty());
  for (const RobotRow& row : record.rows)
    if (row.time > 0) record.path.poses.push_back({row.time, {1, 2, 0}, true});
  const auto quality = scanMapQuality(record);
  EXPECT_NEAR(*quality->pathEntropy, *quality->odometryEntropy, 0.05);
  EXPECT_LT(*quality->pathEntropy, *quality->entropy - 0.5);
  const auto points = scanPoints(record, PosesOf::kPath);
  EXPECT_EQ(points.size(), 19u * 101) << "of the start, the path tells nothing";
  EXPECT_NEAR(points[50].x, 3, 1e-6);
  EXPECT_NEAR(points[50].y, 2, 1e-6);
}

TEST(ScanPoints, AreThinnedEvenly)
{
  Record record = drive(0);
  const auto rows = record.lasers;
  for (int i = 0; i < 200; ++i) record.lasers.insert(record.lasers.end(), rows.begin(), rows.end());
  const auto points = scanPoints(record, PosesOf::kFilter);
  EXPECT_LE(points.size(), 200000u);
  EXPECT_GT(points.size(), 100000u);
}

TEST(WithoutTargets, TakesOutWhatATargetReturns)
{
  Record record = drive(0);
  TargetTrack track;
  for (std::size_t i = 0; i < 10; ++i)  // tracked in the first half of the rows
  {
    TargetRow row;
    row.row = i;
    row.pose.mean = {2.1, 0, 0};
    track.rows.push_back(row);
  }
  record.targets.push_back(track);
  const auto cleaned = withoutTargets(record);
  ASSERT_EQ(cleaned.size(), record.lasers.size());
  for (std::size_t i = 0; i < cleaned.size(); ++i)
    for (std::size_t beam = 0; beam < cleaned[i].scan->ranges.size(); ++beam)
    {
      const bool ofTarget = record.lasers[i].scan->ranges[beam] == 2;
      EXPECT_EQ(std::isinf(cleaned[i].scan->ranges[beam]), ofTarget && i < 10) << i << " " << beam;
    }
}
}  // namespace slamot::eval
