#include <gtest/gtest.h>
#include <slamot/eval/Evaluation.h>

#include <cmath>

#include "testRuns.h"

namespace slamot::eval
{
namespace
{
constexpr int kRows = 20;

/// A perfect robot and two true targets, 3 m and 8 m to the right, moving along y.
struct TargetRun : PerfectRun
{
  TargetRun() : PerfectRun(kRows)
  {
    for (int i = 0; i < kRows; ++i)
    {
      record.rows[i].scan = true;
      truth.targets[0].poses.push_back({double(i), truePose(0, i), true});
      truth.targets[1].poses.push_back({double(i), truePose(1, i), true});
    }
  }

  static Pose2D truePose(int target, int i) { return {target == 0 ? 3.0 : 8.0, 0.1 * i, 1.0}; }

  /// A track on a true target over rows [from, to), off by `dx`, seen at every row.
  TargetTrack track(int id, bool identified, int target, int from, int to, double dx) const
  {
    TargetTrack out;
    out.id = id;
    out.identified = identified;
    for (int i = from; i < to; ++i)
    {
      TargetRow row;
      row.row = static_cast<std::size_t>(i);
      row.pose = gaussian(truePose(target, i), 0.1, 0.1);
      row.pose.mean.x += dx;
      row.lastSeen = i;
      out.rows.push_back(row);
    }
    return out;
  }
};
}  // namespace

TEST(EvaluateTargets, TakesIdentitiesAtTheirWord)
{
  TargetRun run;
  run.record.targets = {run.track(1, true, 0, 5, 15, 0.0)};  // calls target 0 by the name 1
  const Evaluation e = evaluate(run.record, run.truth, {});
  EXPECT_EQ(e.targets[0].truthId, 1);
  EXPECT_NEAR(*e.targets[0].all.positionMean, 5.0, 1e-12);
  EXPECT_NEAR(*e.targets[0].trackedFraction, 10.0 / kRows, 1e-12);
}

TEST(EvaluateTargets, TakesVelocitiesAgainstThePathWhereTruthHasNone)
{
  TargetRun run;
  run.record.targets = {run.track(0, true, 0, 0, kRows, 0.0)};
  for (TargetRow& row : run.record.targets[0].rows) row.velocity = {0.3, 0.5};
  const auto rmse = evaluate(run.record, run.truth, {}).trueTargets[0].velocityRmse;
  ASSERT_TRUE(rmse);
  EXPECT_NEAR((*rmse)[0], 0.3, 1e-9);
  EXPECT_NEAR((*rmse)[1], 0.4, 1e-9);  // the target moves by 0.1 m/s along y
}

TEST(EvaluateTargets, TakesVelocitiesAgainstTheTrueOnesInTheTruthsAxes)
{
  TargetRun run;
  run.record.targets = {run.track(0, true, 0, 0, kRows, 0.0)};
  for (std::size_t i = 0; i < kRows; ++i)
  {
    run.record.targets[0].rows[i].velocity = {2, i == 0 ? 1.0 : 0.0};
    run.truth.targets[0].poses[i].velocity = Vector2(0, 2);
  }
  // A map that lies a quarter turn off: what it calls x is the truth's y.
  const auto rmse =
      evaluate(run.record, run.truth, {}, {0, 0, math::kPi / 2}, {}).trueTargets[0].velocityRmse;
  ASSERT_TRUE(rmse);
  EXPECT_NEAR((*rmse)[0], std::sqrt(1.0 / kRows), 1e-9);
  EXPECT_NEAR((*rmse)[1], 0, 1e-9);
}

TEST(EvaluateTargets, ListsAMissedTargetAsNeverTracked)
{
  TargetRun run;
  run.record.targets = {run.track(0, true, 0, 0, kRows, 0.0)};
  const Evaluation e = evaluate(run.record, run.truth, {});
  ASSERT_EQ(e.targets.size(), 2u);
  EXPECT_EQ(e.targets[1].id, 1);
  EXPECT_DOUBLE_EQ(*e.targets[1].trackedFraction, 0.0);
  EXPECT_FALSE(e.targets[1].all.positionMean);
}

TEST(EvaluateTargets, FindsTheTargetOfAnUnnamedTrackThroughTheRobotsDrift)
{
  TargetRun run;
  run.record.targets = {run.track(0, false, 1, 0, 8, 0.2), run.track(1, false, 0, 0, kRows, 0.1),
                        run.track(2, false, 1, 10, 18, 0.2), run.track(3, false, 0, 0, 3, 30.0)};
  run.moveMap({4, 4, 0.5});  // not aligned: only what the robot sees tells which is which
  const Evaluation e = evaluate(run.record, run.truth, {});
  ASSERT_EQ(e.targets.size(), 4u);
  EXPECT_EQ(e.targets[0].truthId, 1);
  EXPECT_EQ(e.targets[1].truthId, 0);
  EXPECT_EQ(e.targets[2].truthId, 1);
  EXPECT_FALSE(e.targets[3].truthId);
  EXPECT_FALSE(e.targets[3].trackedFraction);
  ASSERT_EQ(e.trueTargets.size(), 2u);
  EXPECT_NEAR(*e.trueTargets[1].relativeAtSightings.positionMean, 0.2, 1e-9);
  EXPECT_NEAR(*e.trueTargets[1].trackedFraction, 16.0 / kRows, 1e-12);
  EXPECT_GT(*e.trueTargets[1].all.positionMean, 1.0);
}

TEST(EvaluateTargets, SortsErrorsByTimeSinceTheLastSighting)
{
  TargetRun run;
  TargetTrack track = run.track(0, true, 0, 0, kRows, 0.0);
  for (int i = 0; i < kRows; ++i)
  {
    track.rows[i].lastSeen = std::min(i, 9);  // not seen after 9 s
    track.rows[i].pose.mean.x += 0.1 * (i - track.rows[i].lastSeen);
  }
  run.record.targets = {track};
  EvaluationOptions options;
  options.sinceSeenEdges = {0, 1, 5, 100};
  const Evaluation e = evaluate(run.record, run.truth, options);
  const auto& bins = e.targets[0].sinceSeen;
  ASSERT_EQ(bins.size(), 3u);
  EXPECT_EQ(bins[0].errors.count, 10);
  EXPECT_NEAR(*bins[0].errors.positionMean, 0.0, 1e-12);
  EXPECT_EQ(bins[1].errors.count, 4);
  EXPECT_NEAR(*bins[1].errors.positionMean, 0.25, 1e-12);
  EXPECT_EQ(bins[2].errors.count, 6);
  EXPECT_EQ(e.targets[0].relativeAtSightings.count, 10);
  EXPECT_EQ(e.targets[0].atSightings.count, 10);
}

TEST(EvaluateTargets, WithoutATrueHeadingHasNoHeadingErrorAndNoFullNees)
{
  TargetRun run;
  for (auto& p : run.truth.targets[0].poses) p.headingKnown = false;
  run.record.targets = {run.track(0, true, 0, 0, kRows, 0.1)};
  const Evaluation e = evaluate(run.record, run.truth, {});
  EXPECT_FALSE(e.targets[0].all.headingRmse);
  EXPECT_FALSE(e.targets[0].all.neesMean);
  EXPECT_NEAR(*e.targets[0].all.neesPositionMean, 1.0, 1e-9);
}
}  // namespace slamot::eval
