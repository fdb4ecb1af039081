#include <gtest/gtest.h>
#include <slamot/eval/Recorder.h>

#include <limits>

namespace slamot::eval
{
namespace
{
struct Map : core::LandmarkView
{
  void visit(const std::function<void(const core::LandmarkEstimate&)>& visitor) const override
  {
    visitor({4, {{1, 2}, Matrix2::Identity()}, 3});
  }
  [[nodiscard]] std::size_t size() const override { return 1; }
};

/// Believes what it is told to.
struct FakeFilter : core::Filter
{
  Map map;
  core::Estimate belief;
  std::vector<core::PathPose> whole;

  core::Update process(const core::Step&) override { return {belief, {}, {}}; }
  [[nodiscard]] core::Estimate estimate() const override
  {
    core::Estimate out = belief;
    out.landmarks = &map;
    return out;
  }
  [[nodiscard]] std::vector<core::PathPose> path() const override { return whole; }
};

core::Step stepAt(double time, bool odometry)
{
  core::Step step;
  step.time = time;
  if (odometry) step.odometry = Gaussian<Pose2D>{{1, 0, 0}, Matrix3::Zero()};
  return step;
}

core::Update beliefAt(double time, double x)
{
  core::Update update;
  update.estimate.time = time;
  update.estimate.robot.mean.x = x;
  return update;
}

core::TargetEstimate target(int id, bool identified)
{
  core::TargetEstimate out;
  out.id = id;
  out.identified = identified;
  return out;
}
}  // namespace

TEST(Recorder, KeepsTheStartAndEveryOdometryStep)
{
  FakeFilter filter;
  Recorder recorder(filter);
  recorder.begin(beliefAt(0, 0).estimate);
  recorder.accept(stepAt(1, true), beliefAt(1, 1));
  recorder.accept(stepAt(1.5, false), beliefAt(1.5, 1.1));
  recorder.accept(stepAt(2, true), beliefAt(2, 2.1));
  recorder.finish(true);
  const Record& r = recorder.record();
  ASSERT_EQ(r.rows.size(), 3u);
  EXPECT_EQ(r.rows[0].time, 0);
  EXPECT_EQ(r.rows[2].robot.mean.x, 2.1);
  EXPECT_EQ(r.rows[2].odometry.x, 2);
  EXPECT_EQ(r.steps.size(), 3u);
  EXPECT_TRUE(r.complete);
}

TEST(Recorder, HasNoRowForAStartOfUnknownTime)
{
  FakeFilter filter;
  Recorder recorder(filter);
  recorder.begin(beliefAt(-std::numeric_limits<double>::infinity(), 0).estimate);
  recorder.accept(stepAt(1, true), beliefAt(1, 1));
  recorder.finish(true);
  EXPECT_EQ(recorder.record().rows.size(), 1u);
}

TEST(Recorder, KeepsTheLastBeliefAboutAnInstant)
{
  FakeFilter filter;
  Recorder recorder(filter);
  recorder.begin(beliefAt(0, 0).estimate);
  core::Step scan = stepAt(0, false);
  scan.blobs.emplace();
  core::Update update = beliefAt(0, 0.5);
  update.estimate.targets = {target(0, false)};
  recorder.accept(scan, update);
  recorder.accept(stepAt(0, false), beliefAt(0, 0.7));
  recorder.finish(true);
  ASSERT_EQ(recorder.record().rows.size(), 1u);
  EXPECT_EQ(recorder.record().rows[0].robot.mean.x, 0.7);
  EXPECT_TRUE(recorder.record().rows[0].scan);
  EXPECT_TRUE(recorder.record().targets.empty());
}

TEST(Recorder, KeepsEveryOdometryStepOfALogWhoseClockStandsStill)
{
  FakeFilter filter;
  Recorder recorder(filter);
  for (int i = 0; i < 5; ++i)
  {
    core::Step step = stepAt(1e9, true);
    if (i == 3) step.landmarks.emplace();
    recorder.accept(step, beliefAt(1e9, i));
  }
  recorder.finish(true);
  const Record& r = recorder.record();
  ASSERT_EQ(r.rows.size(), 5u);
  for (int i = 1; i < 5; ++i)
  {
    EXPECT_GT(r.rows[i].time, r.rows[i - 1].time);
    EXPECT_NEAR(r.rows[i].time, 1e9, 1e-5);
    EXPECT_EQ(r.rows[i].time, r.steps[i].time);
    EXPECT_EQ(r.rows[i].scan, i == 3);
  }
}

TEST(Recorder, FollowsTargetsThroughLossAndReturn)
{
  FakeFilter filter;
  Recorder recorder(filter);
  for (int i = 0; i < 6; ++i)
  {
    core::Update update = beliefAt(i, i);
    if (i != 2 && i != 3) update.estimate.targets = {target(5, true)};
    recorder.accept(stepAt(i, true), update);
  }
  recorder.finish(true);
  ASSERT_EQ(recorder.record().targets.size(), 1u);
  const TargetTrack& track = recorder.record().targets[0];
  ASSERT_EQ(track.rows.size(), 4u);
  EXPECT_EQ(track.rows[2].row, 4u);
}

TEST(Recorder, GivesAnUnnamedTrackANumberThatNoIdentityHas)
{
  FakeFilter filter;
  Recorder recorder(filter);
  core::Update update = beliefAt(0, 0);
  update.estimate.targets = {target(0, false), target(0, true), target(1, true)};
  recorder.accept(stepAt(0, true), update);
  recorder.finish(true);
  const auto& targets = recorder.record().targets;
  ASSERT_EQ(targets.size(), 3u);
  EXPECT_EQ(targets[0].id, 0);
  EXPECT_EQ(targets[1].id, 1);
  EXPECT_EQ(targets[2].id, 2);
  EXPECT_FALSE(targets[2].identified);
}

TEST(Recorder, AsksForTheMapAtTheEnd)
{
  FakeFilter filter;
  Recorder recorder(filter);
  recorder.finish(false);
  EXPECT_TRUE(recorder.record().hasMap);
  ASSERT_EQ(recorder.record().landmarks.size(), 1u);
  EXPECT_EQ(recorder.record().landmarks[0].id, 4);
  EXPECT_FALSE(recorder.record().complete);
}

// Its times are those of the rows, also where the log's clock stands still.
TEST(Recorder, AsksForThePathAtTheEnd)
{
  for (const bool hasStart : {false, true})
  {
    FakeFilter filter;
    Recorder recorder(filter);
    if (hasStart) recorder.begin(beliefAt(1e9, 0).estimate);
    for (int i = 0; i < 5; ++i)
    {
      recorder.accept(stepAt(1e9, true), beliefAt(1e9, i));
      filter.whole.push_back({1e9, {10.0 + i, 0, 0}});
    }
    recorder.finish(true);
    const Record& r = recorder.record();
    ASSERT_EQ(r.path.poses.size(), 5u);
    for (std::size_t i = 0; i < 5; ++i)
    {
      EXPECT_EQ(r.path.poses[i].time, r.rows[i + (hasStart ? 1 : 0)].time);
      EXPECT_EQ(r.path.poses[i].pose.x, 10.0 + double(i));
    }
  }
}

TEST(Recorder, NotesTheSensorsIdentityBesideThePairing)
{
  FakeFilter filter;
  Recorder recorder(filter);
  core::Step step = stepAt(0, true);
  step.landmarks.emplace();
  step.landmarks->sightings = {{1, 0, 0.1, 0.1, 9}, {2, 0, 0.1, 0.1, 8}};
  core::Update update = beliefAt(0, 0);
  update.pairings = {{false, 1, core::Pairing::Outcome::kNew, 8}};
  recorder.accept(step, update);
  recorder.finish(true);
  ASSERT_EQ(recorder.record().pairings.size(), 1u);
  EXPECT_EQ(recorder.record().pairings[0].seenId, 8);
  EXPECT_TRUE(recorder.record().landmarksIdentified());
  EXPECT_EQ(recorder.record().observations, 2u);
}

TEST(Recorder, KeepsLasersOnlyWhereTheRobotMovedOn)
{
  FakeFilter filter;
  Recorder recorder(filter, {true});
  for (int i = 0; i < 10; ++i)
  {
    core::Step step = stepAt(i, true);
    step.lasers = {std::make_shared<core::LaserScan>()};
    recorder.accept(step, beliefAt(i, 0.04 * i));
  }
  recorder.finish(true);
  const auto& lasers = recorder.record().lasers;
  ASSERT_EQ(lasers.size(), 4u);  // at 0, 0.12, 0.24 and 0.36 m
  EXPECT_EQ(lasers[1].row, 3u);
}
}  // namespace slamot::eval
