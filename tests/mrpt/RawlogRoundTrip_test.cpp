#include "bytes.h"
#include "exampleLog.h"

#include <slamot/core/Error.h>

#include <cmath>

namespace slamot::tests
{
namespace
{
using slamot::mrpt::RawlogSource;
using slamot::mrpt::RawlogWriter;
using Format = RawlogWriter::Format;

constexpr double kFloat = 2e-7;  // MRPT stores sightings as floats: relative rounding

void expectSameFov(const core::FieldOfView& a, const core::FieldOfView& b)
{
  EXPECT_NEAR(a.rangeMin, b.rangeMin, 1e-6);
  EXPECT_NEAR(a.rangeMax, b.rangeMax, 1e-6);
  EXPECT_NEAR(a.bearingMin, b.bearingMin, 1e-6);
  EXPECT_NEAR(a.bearingMax, b.bearingMax, 1e-6);
}

void expectSameLandmarks(const core::LandmarkScan& a, const core::LandmarkScan& b)
{
  expectSameFov(a.fov, b.fov);
  ASSERT_EQ(a.sightings.size(), b.sightings.size());
  for (std::size_t i = 0; i < a.sightings.size(); ++i)
  {
    const auto &x = a.sightings[i], &y = b.sightings[i];
    EXPECT_EQ(x.id, y.id);
    EXPECT_NEAR(x.range, y.range, kFloat * y.range);
    EXPECT_NEAR(x.bearing, y.bearing, kFloat * math::kPi);
    EXPECT_NEAR(x.rangeStd, y.rangeStd, kFloat * y.rangeStd);
    EXPECT_NEAR(x.bearingStd, y.bearingStd, kFloat * y.bearingStd);
  }
}

void expectSameBlobs(const core::BlobScan& a, const core::BlobScan& b)
{
  expectSameFov(a.fov, b.fov);
  ASSERT_EQ(a.blobs.size(), b.blobs.size());
  for (std::size_t i = 0; i < a.blobs.size(); ++i)
  {
    const auto &x = a.blobs[i], &y = b.blobs[i];
    EXPECT_EQ(x.label, y.label);
    EXPECT_EQ(x.id, y.id);
    ASSERT_EQ(x.range.has_value(), y.range.has_value());
    if (y.range)
    {
      EXPECT_NEAR(*x.range, *y.range, 1e-12);
      EXPECT_NEAR(x.rangeStd, y.rangeStd, 1e-12);
    }
    EXPECT_NEAR(x.bearing, y.bearing, 1e-12);
    EXPECT_NEAR(x.bearingStd, y.bearingStd, 1e-12);
  }
}

void expectSame(const core::Step& a, const core::Step& b)
{
  SCOPED_TRACE(b.time);
  EXPECT_NEAR(a.time, b.time, 5e-8);  // ticks of 100 ns
  ASSERT_EQ(a.landmarks.has_value(), b.landmarks.has_value());
  if (b.landmarks) expectSameLandmarks(*a.landmarks, *b.landmarks);
  ASSERT_EQ(a.blobs.has_value(), b.blobs.has_value());
  if (b.blobs) expectSameBlobs(*a.blobs, *b.blobs);
  EXPECT_EQ(a.dropped, 0);
}

TEST(RawlogRoundTrip, PairsKeepEverything)
{
  const TemporaryFolder folder;
  const auto steps = exampleSteps();
  RawlogSource source(writeLog(folder, Format::kActionFrames, steps, exampleStarts()), {});
  EXPECT_EQ(source.starts().toIni(), exampleStarts().toIni());
  const auto back = readAll(source);
  ASSERT_EQ(back.size(), steps.size());
  for (std::size_t i = 0; i < steps.size(); ++i)
  {
    expectSame(back[i], steps[i]);
    ASSERT_TRUE(back[i].odometry);
    EXPECT_EQ(back[i].odometry->mean, steps[i].odometry->mean);
    EXPECT_EQ(back[i].odometry->cov, steps[i].odometry->cov);
  }
  EXPECT_TRUE(source.truncation().empty());
}

TEST(RawlogRoundTrip, ObservationsKeepAllButCovariance)
{
  const TemporaryFolder folder;
  const auto steps = exampleSteps();
  RawlogSource source(writeLog(folder, Format::kObservations, steps, exampleStarts()), model());
  EXPECT_EQ(source.starts().toIni(), exampleStarts().toIni());
  const auto back = readAll(source);
  ASSERT_EQ(back.size(), steps.size());
  for (std::size_t i = 0; i < steps.size(); ++i)
  {
    expectSame(back[i], steps[i]);
    ASSERT_TRUE(back[i].odometry);
    EXPECT_NEAR(back[i].odometry->mean.x, steps[i].odometry->mean.x, 1e-12);
    EXPECT_NEAR(back[i].odometry->mean.y, steps[i].odometry->mean.y, 1e-12);
    EXPECT_NEAR(back[i].odometry->mean.phi, steps[i].odometry->mean.phi, 1e-12);
    const auto expected = model().odometry.apply(*steps[i].odometry, 0.025);
    EXPECT_LT((back[i].odometry->cov - expected.cov).norm(), 1e-12);
  }
}

TEST(RawlogRoundTrip, LaserScansKeepTheirBeams)
{
  for (const Format format : {Format::kActionFrames, Format::kObservations})
  {
    const TemporaryFolder folder;
    core::Step step;
    step.time = 1;
    step.lasers.push_back(std::make_shared<core::LaserScan>(
        core::LaserScan{{0.2, 0.1, 0.3}, -1.0, 0.5, 8, {1, 2, 9, 4}}));
    RawlogSource source(writeLog(folder, format, {step}, {}), {});
    const auto back = source.next();
    ASSERT_TRUE(back);
    ASSERT_EQ(back->lasers.size(), 1u);
    const core::LaserScan &a = *back->lasers[0], &b = *step.lasers[0];
    ASSERT_EQ(a.ranges.size(), 4u);
    EXPECT_GT(a.ranges[2], a.rangeMax);
    for (const std::size_t i : {0u, 1u, 3u}) EXPECT_EQ(a.ranges[i], b.ranges[i]);
    EXPECT_NEAR(a.pose_robot_sensor.x, 0.2, 1e-12);
    EXPECT_NEAR(a.pose_robot_sensor.y, 0.1, 1e-12);
    EXPECT_NEAR(a.pose_robot_sensor.phi + a.angleMin, 0.3 - 1.0, 1e-6);
    EXPECT_NEAR(a.angleStep, 0.5, 1e-6);
  }
}

TEST(RawlogRoundTrip, SightingsOutOfReachAreDroppedAndCounted)
{
  const TemporaryFolder folder;
  core::Step step;
  step.time = 1;
  step.landmarks.emplace().fov = {0.5, 5, -1, 1};
  step.landmarks->sightings = {{2, 0, 0.1, 0.01, 1},
                               {-0.1, 0, 0.1, 0.01, 2},
                               {5.1, 0, 0.1, 0.01, 3},
                               {2, 1.1, 0.1, 0.01, 4},
                               {0, 0, 0.1, 0.01, 5}};
  step.blobs.emplace().fov = {0, 5, -1, 1};
  step.blobs->blobs = {{"target", -1.0, 0, 0.1, 0.01, 1}, {"target", {}, 1.5, 0, 0.01, 2}};
  RawlogSource source(writeLog(folder, Format::kObservations, {step}, {}), {});
  const auto back = source.next();
  ASSERT_TRUE(back);
  ASSERT_EQ(back->landmarks->sightings.size(), 1u);
  EXPECT_EQ(back->landmarks->sightings[0].id, 1);
  EXPECT_TRUE(back->blobs->blobs.empty());
  EXPECT_EQ(back->dropped, 6);
  EXPECT_EQ(source.dropped(), 6u);
}

TEST(RawlogRoundTrip, StepWithNothingButItsTimeIsKeptInPairs)
{
  const TemporaryFolder folder;
  core::Step step;
  step.time = 4.5;
  RawlogSource source(writeLog(folder, Format::kActionFrames, {step}, {}), {});
  const auto back = source.next();
  ASSERT_TRUE(back);
  EXPECT_EQ(back->time, 4.5);
  EXPECT_FALSE(back->odometry);
}

TEST(RawlogRoundTrip, SameStepsGiveTheSameBytes)
{
  const TemporaryFolder folder;
  const auto first =
      rawBytes(writeLog(folder, Format::kActionFrames, exampleSteps(), exampleStarts()));
  const auto second =
      rawBytes(writeLog(folder, Format::kActionFrames, exampleSteps(), exampleStarts()));
  EXPECT_FALSE(first.empty());
  EXPECT_EQ(first, second);
}

TEST(RawlogRoundTrip, ObservationsWithoutCovarianceNeedAModel)
{
  const TemporaryFolder folder;
  const auto path = writeLog(folder, Format::kObservations, exampleSteps(), exampleStarts());
  try
  {
    RawlogSource(path, {});
    FAIL();
  }
  catch (const core::Error& e)
  {
    EXPECT_EQ(e.status(), core::ExitStatus::kConfig);
    EXPECT_NE(std::string(e.what()).find("[odometer] noise = model"), std::string::npos);
  }
}
}  // namespace
}  // namespace slamot::tests
