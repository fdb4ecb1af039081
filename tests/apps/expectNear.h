#pragma once

#include <gtest/gtest.h>
#include <slamot/core/Start.h>
#include <slamot/core/run.h>
#include <slamot/eval/Truth.h>

namespace slamot::test
{
// A rawlog holds sightings as floats and times in ticks of 100 ns; doubles since 1970 are no finer.
inline constexpr double kFloat = 2e-6, kTick = 3e-7;

inline void expectNear(const core::LandmarkScan& a, const core::LandmarkScan& b)
{
  ASSERT_EQ(a.sightings.size(), b.sightings.size());
  for (std::size_t i = 0; i < a.sightings.size(); ++i)
  {
    EXPECT_NEAR(a.sightings[i].range, b.sightings[i].range, kFloat);
    EXPECT_NEAR(math::wrapToPi(a.sightings[i].bearing - b.sightings[i].bearing), 0, kFloat);
    EXPECT_NEAR(a.sightings[i].rangeStd, b.sightings[i].rangeStd, kFloat);
    EXPECT_NEAR(a.sightings[i].bearingStd, b.sightings[i].bearingStd, kFloat);
    EXPECT_EQ(a.sightings[i].id, b.sightings[i].id);
  }
  EXPECT_NEAR(a.fov.rangeMax, b.fov.rangeMax, kFloat);
  EXPECT_NEAR(a.fov.bearingMin, b.fov.bearingMin, kFloat);
}

inline void expectNear(const core::BlobScan& a, const core::BlobScan& b)
{
  ASSERT_EQ(a.blobs.size(), b.blobs.size());
  for (std::size_t i = 0; i < a.blobs.size(); ++i)
  {
    const core::Blob &p = a.blobs[i], &q = b.blobs[i];
    ASSERT_EQ(p.range.has_value(), q.range.has_value());
    EXPECT_NEAR(p.range.value_or(0), q.range.value_or(0), kFloat);
    EXPECT_NEAR(math::wrapToPi(p.bearing - q.bearing), 0, kFloat);
    EXPECT_NEAR(p.bearingStd, q.bearingStd, kFloat);
    EXPECT_TRUE(p.label == q.label && p.id == q.id);
  }
}

inline void expectNear(const Gaussian<Pose2D>& a, const Gaussian<Pose2D>& b)
{
  const Pose2D d = math::between(a.mean, b.mean);
  EXPECT_NEAR(std::abs(d.x) + std::abs(d.y) + std::abs(d.phi), 0, 1e-9);
  EXPECT_NEAR((a.cov - b.cov).cwiseAbs().maxCoeff(), 0, 1e-8);
}

inline void expectNear(const core::LaserScan& a, const core::LaserScan& b)
{
  EXPECT_NEAR(a.pose_robot_sensor.x, b.pose_robot_sensor.x, kFloat);
  EXPECT_NEAR(a.pose_robot_sensor.y, b.pose_robot_sensor.y, kFloat);
  // Where the first beam points: a rawlog turns the sensor to the middle of its field of view.
  const double turn = a.pose_robot_sensor.phi + a.angleMin - b.pose_robot_sensor.phi - b.angleMin;
  EXPECT_NEAR(math::wrapToPi(turn), 0, kFloat);
  EXPECT_NEAR(a.angleStep, b.angleStep, kFloat);
  EXPECT_NEAR(a.rangeMax, b.rangeMax, kFloat * a.rangeMax);
  ASSERT_EQ(a.ranges.size(), b.ranges.size());
  for (std::size_t i = 0; i < a.ranges.size(); ++i)
  {
    const bool isReturn = a.ranges[i] <= a.rangeMax;
    ASSERT_EQ(isReturn, b.ranges[i] <= b.rangeMax) << i;
    ASSERT_TRUE(!isReturn || a.ranges[i] == b.ranges[i]) << i;
  }
}

inline void expectNear(const core::Step& a, const core::Step& b)
{
  EXPECT_NEAR(a.time, b.time, kTick);
  EXPECT_EQ(a.dropped, b.dropped);
  ASSERT_EQ(a.odometry.has_value(), b.odometry.has_value());
  if (a.odometry) expectNear(*a.odometry, *b.odometry);
  ASSERT_EQ(a.landmarks.has_value(), b.landmarks.has_value());
  ASSERT_EQ(a.blobs.has_value(), b.blobs.has_value());
  if (a.landmarks) expectNear(*a.landmarks, *b.landmarks);
  if (a.blobs) expectNear(*a.blobs, *b.blobs);
  ASSERT_EQ(a.lasers.size(), b.lasers.size());
  for (std::size_t i = 0; i < a.lasers.size(); ++i) expectNear(*a.lasers[i], *b.lasers[i]);
}

// The number of steps, all alike.
inline int expectNear(core::Source& a, core::Source& b)
{
  for (int n = 0;; ++n)
  {
    const auto p = a.next(), q = b.next();
    EXPECT_EQ(p.has_value(), q.has_value()) << "after " << n << " steps";
    if (!p || !q) return n;
    expectNear(*p, *q);
    if (testing::Test::HasFailure()) return n;
  }
}

inline void expectNear(const eval::Trajectory& a, const eval::Trajectory& b)
{
  ASSERT_EQ(a.poses.size(), b.poses.size());
  for (std::size_t i = 0; i < a.poses.size(); ++i)
  {
    EXPECT_NEAR(a.poses[i].time, b.poses[i].time, 2e-9);
    EXPECT_EQ(a.poses[i].headingKnown, b.poses[i].headingKnown);
    if (!a.poses[i].headingKnown) continue;
    const Pose2D d = math::between(a.poses[i].pose, b.poses[i].pose);
    EXPECT_NEAR(std::abs(d.x) + std::abs(d.y) + std::abs(d.phi), 0, 1e-8);
  }
}

inline void expectNear(const eval::Truth& a, const eval::Truth& b)
{
  expectNear(a.robot, b.robot);
  ASSERT_EQ(a.targets.size(), b.targets.size());
  for (const auto& [id, trajectory] : a.targets) expectNear(trajectory, b.targets.at(id));
  ASSERT_EQ(a.landmarks.size(), b.landmarks.size());
  for (const auto& [id, p] : a.landmarks)
    EXPECT_NEAR(std::hypot(p.x - b.landmarks.at(id).x, p.y - b.landmarks.at(id).y), 0, 1e-8);
  ASSERT_EQ(a.relations.size(), b.relations.size());
  for (std::size_t i = 0; i < a.relations.size(); ++i)
  {
    EXPECT_NEAR(a.relations[i].from, b.relations[i].from, 2e-9);
    EXPECT_NEAR(a.relations[i].to, b.relations[i].to, 2e-9);
    const Pose2D d = math::between(a.relations[i].pose_from_to, b.relations[i].pose_from_to);
    EXPECT_NEAR(std::abs(d.x) + std::abs(d.y) + std::abs(d.phi), 0, 1e-8);
  }
  ASSERT_EQ(a.associations.size(), b.associations.size());
  for (std::size_t i = 0; i < a.associations.size(); ++i)
  {
    EXPECT_NEAR(a.associations[i].time, b.associations[i].time, 2e-9);
    EXPECT_EQ(a.associations[i].index, b.associations[i].index);
    EXPECT_EQ(a.associations[i].id, b.associations[i].id);
  }
}

inline void expectNear(const core::ObjectStart& a, const core::ObjectStart& b)
{
  for (std::size_t i = 0; i < a.value.size(); ++i)
  {
    EXPECT_EQ(a.value[i].has_value(), b.value[i].has_value());
    EXPECT_NEAR(a.value[i].value_or(0), b.value[i].value_or(0), 1e-12);
    EXPECT_NEAR(a.std[i].value_or(0), b.std[i].value_or(0), 1e-12);
  }
}
}  // namespace slamot::test
