#include "worlds.h"

#include <slamot/core/checkStep.h>

#include <set>

namespace slamot::sim
{
namespace
{
using test::drain;
using test::scenario;

const std::vector<std::string> kNoNoise = {"robot.v_std_mps=0",
                                           "robot.omega_std_radps=0",
                                           "landmark_sensor.range_std_m=1e-12",
                                           "target_sensor.range_std_m=1e-12",
                                           "landmark_sensor.bearing_std_rad=1e-12",
                                           "target_sensor.bearing_std_rad=1e-12"};

TEST(World, SameSeedSameSteps)
{
  World a(scenario(), 7), b(scenario(), 7), c(scenario(), 8);
  const auto stepsA = drain(a), stepsB = drain(b), stepsC = drain(c);
  ASSERT_EQ(stepsA.size(), 320u);
  ASSERT_EQ(stepsB.size(), 320u);
  for (std::size_t i = 0; i < stepsA.size(); ++i) test::expectSame(stepsA[i], stepsB[i]);
  EXPECT_NE(stepsA[7].blobs->blobs.at(0).range, stepsC[7].blobs->blobs.at(0).range);
  EXPECT_NE(a.truth().landmarks.at(0), c.truth().landmarks.at(0));
}

TEST(World, ScansAtEveryEighthStepAndIsWhatFiltersDemand)
{
  World world(scenario(), 1);
  double last = *world.starts().time;
  int n = 0;
  while (const auto step = world.next())
  {
    ++n;
    EXPECT_NO_THROW(core::checkStep(*step, last));
    EXPECT_NEAR(step->time, n * 0.025, 1e-12);
    EXPECT_EQ(step->landmarks.has_value(), n % 8 == 0);
    EXPECT_EQ(step->blobs.has_value(), n % 8 == 0);
    last = step->time;
  }
  EXPECT_EQ(n, 320);
  EXPECT_EQ(world.truth().robot.poses.size(), 321u);
  EXPECT_EQ(world.truth().targets.at(1).poses.size(), 321u);
  EXPECT_EQ(world.progress(), 1);
}

TEST(World, WithoutNoiseSightingsAreTheTrueGeometry)
{
  World world(scenario(kNoNoise), 3);
  int sightings = 0;
  while (const auto step = world.next())
  {
    if (!step->landmarks) continue;
    const Pose2D robot = world.truth().robot.poses.back().pose;
    const Pose2D target = world.truth().targets.at(1).poses.back().pose;
    std::set<int> seen;
    for (const core::Sighting& s : step->landmarks->sightings)
    {
      const auto z = models::RangeBearing::predict(robot, world.truth().landmarks.at(s.id));
      EXPECT_NEAR(s.range, z[0], 1e-10);
      EXPECT_NEAR(math::wrapToPi(s.bearing - z[1]), 0, 1e-10);
      seen.insert(s.id);
      ++sightings;
    }
    for (const auto& [id, at] : world.truth().landmarks)
      EXPECT_EQ(seen.count(id) > 0, models::RangeBearing::predict(robot, at)[0] <= 5) << id;
    const auto z = models::RangeBearing::predict(robot, {target.x, target.y});
    ASSERT_EQ(step->blobs->blobs.size(), z[0] <= 5 ? 1u : 0u);
    for (const core::Blob& b : step->blobs->blobs) EXPECT_NEAR(*b.range, z[0], 1e-10);
  }
  EXPECT_GT(sightings, 200);
}

TEST(World, WithoutNoiseOdometrySumsUpToTheTruth)
{
  World world(scenario(kNoNoise), 3);
  Pose2D pose = world.starts().robotPose().mean;
  while (const auto step = world.next()) pose = math::compose(pose, step->odometry->mean);
  const Pose2D truth = world.truth().robot.poses.back().pose;
  EXPECT_NEAR(pose.x, truth.x, 1e-9);
  EXPECT_NEAR(pose.y, truth.y, 1e-9);
  EXPECT_NEAR(math::wrapToPi(pose.phi - truth.phi), 0, 1e-9);
}

TEST(World, MoreLandmarksLeaveAllOtherDrawsAsTheyWere)
{
  World few(scenario({"world.landmarks=20"}), 5), many(scenario({"world.landmarks=100"}), 5);
  const auto a = drain(few), b = drain(many);
  EXPECT_EQ(few.truth().robot.poses.back().pose, many.truth().robot.poses.back().pose);
  for (const auto& [id, at] : few.truth().landmarks) EXPECT_EQ(at, many.truth().landmarks.at(id));
  for (std::size_t i = 7; i < a.size(); i += 8)
  {
    EXPECT_EQ(a[i].blobs->blobs[0].range, b[i].blobs->blobs[0].range);
    for (const core::Sighting& s : a[i].landmarks->sightings)
      EXPECT_TRUE(std::any_of(b[i].landmarks->sightings.begin(), b[i].landmarks->sightings.end(),
                              [&](const core::Sighting& t) {
                                return s.id == t.id && s.range == t.range && s.bearing == t.bearing;
                              }));
  }
}

TEST(World, TargetsComeAndGo)
{
  World world(scenario({"target.present_s=1,3,5,100"}), 2);
  EXPECT_TRUE(world.starts().targets.empty());  // it is not there at the start
  int seen = 0;
  while (const auto step = world.next())
  {
    const bool there = (step->time >= 1 && step->time < 3) || step->time >= 5;
    const std::size_t blobs = step->blobs ? step->blobs->blobs.size() : 0;
    EXPECT_TRUE(there || blobs == 0) << step->time;
    seen += static_cast<int>(blobs);
  }
  EXPECT_GT(seen, 10);
  const auto& rows = world.truth().targets.at(1).poses;
  EXPECT_EQ(rows.front().time, 1);
  EXPECT_EQ(rows.size(), 80u + 121u);
  for (const auto& row : rows) EXPECT_FALSE(row.time >= 3 && row.time < 5);
}

TEST(World, SeveralTargetsKeepTheirNumbersAndLabels)
{
  World world(scenario({"target_7.motion=straight", "target_7.start=given", "target_7.start_x_m=5",
                        "target_7.start_y_m=5", "target_7.speed_mps=0", "target_7.v_std_mps=0",
                        "target_7.omega_std_radps=0", "target_7.label=red"}),
              2);
  EXPECT_EQ(world.starts().targets.count(7), 1u);
  int red = 0;
  for (const auto& step : drain(world))
    if (step.blobs)
      for (const core::Blob& b : step.blobs->blobs)
      {
        EXPECT_EQ(b.label, b.id == 7 ? "red" : "target");
        red += b.id == 7;
      }
  EXPECT_GT(red, 10);
  EXPECT_EQ(world.truth().targets.at(7).poses.back().pose.x, 5);
}

TEST(World, SensorsMayKeepIdentitiesAndRangesToThemselves)
{
  World world(scenario({"landmark_sensor.identities=false", "target_sensor.identities=false",
                        "target_sensor.bearing_only=true"}),
              2);
  for (const auto& step : drain(world))
  {
    if (!step.landmarks) continue;
    for (const core::Sighting& s : step.landmarks->sightings) EXPECT_EQ(s.id, core::kNoId);
    for (const core::Blob& b : step.blobs->blobs)
    {
      EXPECT_EQ(b.id, core::kNoId);
      EXPECT_FALSE(b.range.has_value());
      EXPECT_GT(b.bearingStd, 0);
    }
  }
  for (const auto& a : world.truth().associations) EXPECT_GE(a.id, 0);
}

TEST(World, NarrowFieldOfViewHoldsAllSightings)
{
  World world(scenario({"landmark_sensor.bearing_min_deg=-30", "landmark_sensor.bearing_max_deg=60",
                        "landmark_sensor.range_min_m=1", "landmark_sensor.clutter_per_scan=2"}),
              2);
  int sightings = 0;
  for (const auto& step : drain(world))
    if (step.landmarks)
      for (const core::Sighting& s : step.landmarks->sightings)
      {
        EXPECT_TRUE(s.range >= 1 && s.range <= 5);
        EXPECT_TRUE(s.bearing >= -math::kPi / 6 - 1e-12 && s.bearing <= math::kPi / 3 + 1e-12);
        ++sightings;
      }
  EXPECT_GT(sightings, 100);
}

TEST(World, DropsAndCountsWhatAReaderOfTheRawLogWouldDrop)
{
  const Scenario s = scenario({"world.landmarks=60", "landmark_sensor.range_std_m=0.8"});
  World asRead(s, 4), raw(s, 4, World::Sightings::kRaw);
  const auto a = drain(asRead), b = drain(raw);
  int dropped = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    if (!a[i].landmarks) continue;
    std::vector<double> kept;
    for (const core::Sighting& z : b[i].landmarks->sightings)
      if (z.range > 0 && b[i].landmarks->fov.contains(z.range, z.bearing)) kept.push_back(z.range);
    ASSERT_EQ(kept.size(), a[i].landmarks->sightings.size());
    for (std::size_t k = 0; k < kept.size(); ++k)
      EXPECT_EQ(kept[k], a[i].landmarks->sightings[k].range);
    EXPECT_EQ(b[i].dropped, 0);
    EXPECT_EQ(b[i].landmarks->sightings.size() - kept.size() + b[i].blobs->blobs.size() -
                  a[i].blobs->blobs.size(),
              static_cast<std::size_t>(a[i].dropped));
    dropped += a[i].dropped;
  }
  EXPECT_GT(dropped, 20);
  ASSERT_EQ(asRead.truth().associations.size(), raw.truth().associations.size());
  for (std::size_t i = 0; i < raw.truth().associations.size(); ++i)
    EXPECT_EQ(asRead.truth().associations[i].index, raw.truth().associations[i].index);
}

TEST(World, AssociationsNameTheSightingsOfTheirStep)
{
  World world(scenario({"landmark_sensor.clutter_per_scan=1", "landmark_sensor.range_std_m=0.5"}),
              4);
  std::size_t next = 0;
  while (const auto step = world.next())
  {
    if (!step->landmarks) continue;
    for (std::size_t i = 0; i < step->landmarks->sightings.size(); ++i, ++next)
    {
      const auto& a = world.truth().associations.at(next);
      EXPECT_EQ(a.time, step->time);
      EXPECT_EQ(a.index, static_cast<int>(i));
      EXPECT_EQ(a.id, step->landmarks->sightings[i].id);
    }
  }
  EXPECT_EQ(next, world.truth().associations.size());
}
}  // namespace
}  // namespace slamot::sim
