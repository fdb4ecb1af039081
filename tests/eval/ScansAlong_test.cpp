#include <gtest/gtest.h>
#include <slamot/eval/ScanMap.h>
#include <slamot/eval/ScansAlong.h>

namespace slamot::eval
{
namespace
{
/// A robot that says it drove 0.5 m a second along x, with a scan of one beam each second.
class Log : public core::Source
{
 public:
  std::optional<core::Step> next() override
  {
    if (++at_ > 10) return std::nullopt;
    core::Step step;
    step.time = at_;
    step.odometry = Gaussian<Pose2D>{{0.5, 0, 0}, Matrix3::Zero()};
    auto scan = std::make_shared<core::LaserScan>();
    scan->rangeMax = 30;
    scan->ranges = {static_cast<float>(at_)};
    step.lasers.push_back(scan);
    return step;
  }

 private:
  int at_ = 0;
};

/// A path along y at a speed [m/s], one pose every `every` seconds.
Record pathAlongY(double speed, double from, double until, double every)
{
  Record out;
  for (double t = from; t <= until; t += every)
  {
    RobotRow row;
    row.time = t;
    row.robot.mean = {0, speed * t, math::kPi / 2};
    out.rows.push_back(row);
  }
  return out;
}
}  // namespace

TEST(ScansAlong, StandWhereThePathHasThem)
{
  Log log;
  const ScansAlong out = scansAlong(pathAlongY(2, 0.5, 20, 1), log);  // between its poses
  ASSERT_EQ(out.record.lasers.size(), 10u);
  EXPECT_EQ(out.leftOut, 0u);
  for (std::size_t i = 0; i < 10; ++i)
  {
    const RobotRow& row = out.record.rows[out.record.lasers[i].row];
    const double t = static_cast<double>(i) + 1;
    EXPECT_EQ(out.record.lasers[i].scan->ranges[0], t);
    EXPECT_EQ(row.time, t);
    EXPECT_NEAR(row.robot.mean.y, 2 * t, 1e-9);
    // Odometry sets out from where the path has the first scan: its x is the path's y there.
    EXPECT_NEAR(row.odometry.y, 2 + 0.5 * static_cast<double>(i), 1e-9);
    EXPECT_NEAR(row.odometry.x, 0, 1e-9);
  }
  const auto points = scanPoints(out.record, PosesOf::kFilter);
  EXPECT_NEAR(points.at(3).y, 2 * 4 + 4, 1e-9);
}

TEST(ScansAlong, AreThinnedAsARunsAreAndOdometryGoesOn)
{
  Log log;
  const ScansAlong out = scansAlong(pathAlongY(0.04, 0, 20, 1), log);
  ASSERT_EQ(out.record.rows.size(), 4u);  // at 1, 4, 7 and 10 s
  EXPECT_EQ(out.record.rows[1].time, 4);
  EXPECT_NEAR(out.record.rows[3].odometry.y, 0.04 + 9 * 0.5, 1e-9);
  EXPECT_EQ(out.leftOut, 0u);
}

TEST(ScansAlong, WithoutAPoseAreCounted)
{
  Log log;
  EXPECT_EQ(scansAlong(pathAlongY(1, 3, 7, 1), log).leftOut, 5u);
  Log again;
  const ScansAlong out = scansAlong(pathAlongY(1, 0, 12, 4), again);  // gaps are too wide
  EXPECT_EQ(out.leftOut, 8u);
  EXPECT_EQ(out.record.lasers.size(), 2u);
}

TEST(ScansAlong, AreWithoutWhatTargetsReturn)
{
  Record path = pathAlongY(1, 0, 12, 1);
  TargetTrack track;
  TargetRow target;
  target.row = 5;
  target.pose.mean = {0, 10, 0};  // where the beam of 5 s ends
  track.rows.push_back(target);
  path.targets.push_back(track);
  Log log;
  const ScansAlong out = scansAlong(path, log);
  for (const LaserRow& laser : out.record.lasers)
    EXPECT_EQ(std::isinf(laser.scan->ranges[0]), out.record.rows[laser.row].time == 5);
}
}  // namespace slamot::eval
