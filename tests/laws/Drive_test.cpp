#include <slamot/laws/Drive.h>
#include <slamot/models/RangeBearing.h>

#include <gtest/gtest.h>

namespace
{
using namespace slamot;
using laws::drive;
using laws::World;

TEST(Drive, AnotherStartIsTheSameWorldMoved)
{
  const Pose2D start{3, -5, 2};
  const auto a = drive(World{}, 7), b = drive(World{}, 7, start);
  ASSERT_EQ(a.steps.size(), b.steps.size());
  for (std::size_t i = 0; i < a.steps.size(); ++i)
  {
    const Pose2D expected = math::compose(start, a.robot[i]);
    EXPECT_NEAR(expected.x, b.robot[i].x, 1e-9);
    EXPECT_NEAR(expected.y, b.robot[i].y, 1e-9);
    ASSERT_EQ(a.steps[i].landmarks.has_value(), b.steps[i].landmarks.has_value());
    if (!a.steps[i].landmarks) continue;
    const auto &s = a.steps[i].landmarks->sightings, &t = b.steps[i].landmarks->sightings;
    ASSERT_EQ(s.size(), t.size());
    for (std::size_t k = 0; k < s.size(); ++k) EXPECT_NEAR(s[k].range, t[k].range, 1e-9);
  }
}

TEST(Drive, NoiseIsWhatTheStepsTell)
{
  World world;
  world.steps = 1;
  world.targets = 0;
  world.dt = 1;
  double turnSquares = 0, forward = 0;
  constexpr int kRuns = 4000;
  for (int seed = 1; seed <= kRuns; ++seed)
  {
    const auto d = drive(world, seed);
    const Pose2D e = math::between(d.steps[0].odometry->mean, d.robot[0]);
    turnSquares += e.phi * e.phi;
    forward += math::between({}, d.robot[0]).x;
  }
  // The standard error of a variance is sqrt(2 / n) of it; five of them.
  EXPECT_NEAR(turnSquares / kRuns / (world.turnRateStd * world.turnRateStd), 1.0,
              5 * std::sqrt(2.0 / kRuns));
  EXPECT_NEAR(forward / kRuns, world.speed * std::cos(world.turnRate), 0.02);
}

TEST(Drive, WithoutIdentitiesTheSensorTellsNone)
{
  World world;
  world.identities = false;
  int seen = 0;
  const auto d = drive(world, 1);
  for (const core::Step& step : d.steps)
  {
    if (!step.landmarks) continue;
    for (const core::Sighting& s : step.landmarks->sightings)
    {
      EXPECT_EQ(s.id, core::kNoId);
      ++seen;
    }
  }
  EXPECT_GT(seen, 50);
}
}  // namespace
