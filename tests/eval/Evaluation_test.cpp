#include <gtest/gtest.h>
#include <slamot/eval/Evaluation.h>
#include <slamot/math/random.h>
#include <slamot/math/statistics.h>

#include <cmath>

#include "testRuns.h"

namespace slamot::eval
{
namespace
{
EvaluationOptions with(Align align)
{
  EvaluationOptions out;
  out.align = align;
  return out;
}

core::LandmarkEstimate landmark(int id, double x, double y)
{
  core::LandmarkEstimate m;
  m.id = id;
  m.position.mean = {x, y};
  m.position.cov = 0.01 * Matrix2::Identity();
  m.sightings = 1;
  return m;
}

PairingRow pairing(double time, int index, core::Pairing::Outcome outcome, int id, int seenId = -1)
{
  return {time, {false, index, outcome, id}, seenId};
}

constexpr auto kKnown = core::Pairing::Outcome::kKnown;
constexpr auto kNew = core::Pairing::Outcome::kNew;
constexpr auto kRejected = core::Pairing::Outcome::kRejected;
}  // namespace

TEST(Evaluate, SumsUpErrorsAsDefined)
{
  PerfectRun run(4);
  run.record.rows[1].robot.mean.x += 0.3;
  run.record.rows[2].robot.mean.y -= 0.4;
  run.record.rows[3].robot.mean.phi += 0.2;
  run.record.rows[2].scan = true;
  const Evaluation e = evaluate(run.record, run.truth, {});
  EXPECT_EQ(e.robot.all.count, 4);
  EXPECT_NEAR(*e.robot.all.positionMean, (0.3 + 0.4) / 4, 1e-12);
  EXPECT_NEAR(*e.robot.all.positionMedian, 0.15, 1e-12);  // of 0, 0, 0.3, 0.4
  EXPECT_NEAR(*e.robot.all.positionRmse, std::sqrt((0.09 + 0.16) / 4), 1e-12);
  EXPECT_NEAR(*e.robot.all.headingRmse, std::sqrt(0.04 / 4), 1e-12);
  EXPECT_NEAR(*e.robot.all.neesMean, (9.0 + 16.0 + 4.0) / 4, 1e-9);
  EXPECT_NEAR(*e.robot.all.neesPositionMean, (9.0 + 16.0) / 4, 1e-9);
  EXPECT_NEAR(*e.robot.all.coverage95, 0.5, 1e-12);  // 3 and 4 sigma are outside
  EXPECT_EQ(e.robot.atScans.count, 1);
  EXPECT_NEAR(*e.robot.atScans.positionMean, 0.4, 1e-12);
}

TEST(Evaluate, HoldsEachRowAgainstItsOwnTruthWhereAClockStandsStill)
{
  PerfectRun run(50);
  for (std::size_t i = 0; i < 50; ++i)
  {
    const double time = 1571493463.360583305 + 1e-6 * static_cast<double>(i);
    run.record.rows[i].time = time;
    run.truth.robot.poses[i].time = time + (i % 2 == 0 ? 2e-7 : -2e-7);  // as text rounds it
  }
  const Evaluation e = evaluate(run.record, run.truth, {});
  EXPECT_EQ(e.robot.all.count, 50);
  EXPECT_LT(*e.robot.all.positionMean, 1e-12);
}

TEST(Evaluate, WrapsTheHeadingError)
{
  PerfectRun run(1);
  run.truth.robot.poses[0].pose.phi = 3.1;
  run.record.rows[0].robot.mean.phi = -3.1;
  EXPECT_NEAR(*evaluate(run.record, run.truth, {}).robot.all.headingRmse, 2 * math::kPi - 6.2,
              1e-12);
}

TEST(Evaluate, AlignmentUndoesAMovedMapCovariancesIncluded)
{
  PerfectRun run(30);
  math::RandomStream random{6};
  for (RobotRow& row : run.record.rows)
  {
    row.robot.cov.diagonal() = Vector3(0.04, 0.0001, 0.01);  // long in x: must turn along
    row.robot.mean.x += 0.2 * random.normal();
    row.robot.mean.y += 0.01 * random.normal();
  }
  run.record.rows[0].robot.mean = run.truth.robot.poses[0].pose;
  run.record.hasMap = true;
  run.record.landmarks = {landmark(0, 1, 1), landmark(1, 2, 0)};
  run.truth.landmarks = {{7, {1, 1.1}}, {8, {2, 0}}};
  const Evaluation still = evaluate(run.record, run.truth, with(Align::kFirstPose));
  const Evaluation rigid = evaluate(run.record, run.truth, with(Align::kRigid));
  run.moveMap({3, -2, 1.1});
  const Evaluation moved = evaluate(run.record, run.truth, with(Align::kFirstPose));
  EXPECT_NEAR(*moved.robot.all.neesMean, *still.robot.all.neesMean, 1e-6);
  EXPECT_NEAR(*moved.robot.all.positionRmse, *still.robot.all.positionRmse, 1e-9);
  EXPECT_NEAR(*moved.landmarks.rmse, std::sqrt(0.01 / 2), 1e-9);
  EXPECT_NEAR(*moved.landmarks.neesMean, 0.5, 1e-6);
  const Evaluation movedRigid = evaluate(run.record, run.truth, with(Align::kRigid));
  EXPECT_NEAR(*movedRigid.robot.all.positionRmse, *rigid.robot.all.positionRmse, 1e-9);
  EXPECT_LE(*rigid.robot.all.positionRmse, *still.robot.all.positionRmse);
}

/// A run whose truth is the path of an antenna, 0.5 m ahead and 0.3 m to the right of the robot.
PerfectRun runWithAntenna(const Point2D& antenna)
{
  PerfectRun run(30);
  for (TimedPose& p : run.truth.robot.poses)
    p = {p.time, math::compose(p.pose, {antenna.x, antenna.y, 0}), false};
  return run;
}

TEST(Evaluate, TakesErrorsAtTheEndOfTheLeverArm)
{
  const Point2D antenna(0.5, -0.3);
  PerfectRun run = runWithAntenna(antenna);
  EvaluationOptions options = with(Align::kNone);
  EXPECT_NEAR(*evaluate(run.record, run.truth, options).robot.all.positionRmse,
              std::hypot(0.5, 0.3), 1e-12);
  options.leverArm = antenna;
  EXPECT_NEAR(*evaluate(run.record, run.truth, options).robot.all.positionRmse, 0, 1e-12);
  options.align = Align::kRigid;
  run.moveMap({3, -2, 1.1});
  EXPECT_NEAR(*evaluate(run.record, run.truth, options).robot.all.positionRmse, 0, 1e-9);
  options.leverArm = {};
  EXPECT_GT(*evaluate(run.record, run.truth, options).robot.all.positionRmse, 0.01)
      << "no alignment can undo an arm that turns with the robot";
}

TEST(Evaluate, ALeverArmTurnsDoubtOfHeadingIntoDoubtOfPlace)
{
  PerfectRun run = runWithAntenna({2, 0});
  run.truth.robot.poses.resize(1);
  run.truth.robot.poses[0].pose.y += 0.3;  // heading 0 there, deviations 0.1 m and 0.1 rad
  EvaluationOptions options = with(Align::kNone);
  options.leverArm = {2, 0};
  const Evaluation e = evaluate(run.record, run.truth, options);
  EXPECT_NEAR(*e.robot.all.neesPositionMean, 0.09 / (0.01 + 4 * 0.01), 1e-9);
  EXPECT_NEAR(*e.robot.all.positionMean, 0.3, 1e-12);
}

TEST(Evaluate, LeavesSingularCovariancesOutOfNees)
{
  PerfectRun run(3);
  run.record.rows[0].robot.cov.setZero();
  // Rank 2 in skew directions, as after one step from an exact start.
  run.record.rows[1].robot.cov = Vector3(1, 2, 3) * Vector3(1, 2, 3).transpose() +
                                 Vector3(1, 0, 1) * Vector3(1, 0, 1).transpose();
  const Evaluation e = evaluate(run.record, run.truth, {});
  EXPECT_FALSE(e.robot.steps[0].nees);
  EXPECT_FALSE(e.robot.steps[1].nees);
  EXPECT_TRUE(e.robot.steps[1].neesPosition);
  EXPECT_TRUE(e.robot.steps[2].nees);
  EXPECT_EQ(e.robot.all.neesSkipped, 1);
}

TEST(Evaluate, LeavesCollapsedCovariancesOutOfNees)
{
  PerfectRun run(3);
  run.record.rows[0].robot.cov = 1e-290 * Matrix3::Identity();
  run.record.rows[1].robot.cov = 1e-60 * Matrix3::Identity();
  run.record.rows[0].robot.mean.x += 1e5;
  run.record.rows[1].robot.mean.x += 1e5;
  const Evaluation e = evaluate(run.record, run.truth, {});
  EXPECT_FALSE(e.robot.steps[0].nees);
  EXPECT_FALSE(e.robot.steps[0].neesPosition);
  EXPECT_TRUE(e.robot.steps[1].nees);  // over-confident, and told
  EXPECT_TRUE(std::isfinite(*e.robot.all.neesMean));
  EXPECT_GT(*e.robot.all.neesMean, 1e60);
}

TEST(Evaluate, NeesOfDrawnErrorsIsChiSquare)
{
  PerfectRun run(4000);
  math::RandomStream random{7};
  Matrix3 L;
  L << 0.3, 0, 0, 0.1, 0.05, 0, -0.02, 0.03, 0.04;
  for (RobotRow& row : run.record.rows)
  {
    const Vector3 e = L * random.normal3();
    row.robot.cov = L * L.transpose();
    row.robot.mean.x += e[0], row.robot.mean.y += e[1], row.robot.mean.phi += e[2];
  }
  const Evaluation e = evaluate(run.record, run.truth, {});
  // 4 deviations of the mean: sqrt(2 dof / n).
  EXPECT_NEAR(*e.robot.all.neesMean, 3.0, 4 * std::sqrt(6.0 / 4000));
  EXPECT_NEAR(*e.robot.all.neesPositionMean, 2.0, 4 * std::sqrt(4.0 / 4000));
  EXPECT_NEAR(*e.robot.all.coverage95, 0.95, 4 * std::sqrt(0.95 * 0.05 / 4000));
}

TEST(Evaluate, WithoutTruthHasNoErrors)
{
  PerfectRun run(3);
  run.record.hasMap = true;
  run.record.landmarks = {landmark(0, 1, 1)};
  run.record.pairings = {pairing(1, 0, kNew, 0), pairing(2, 0, kKnown, 0),
                         pairing(2, 1, kRejected, -1)};
  const Evaluation e = evaluate(run.record, Truth{}, with(Align::kFirstPose));
  EXPECT_EQ(e.robot.all.count, 0);
  EXPECT_FALSE(e.robot.all.positionMean || e.robot.all.neesMean || e.robot.all.coverage95);
  EXPECT_EQ(e.landmarks.mapped, 1);
  EXPECT_FALSE(e.landmarks.trueOnes || e.landmarks.rmse || e.landmarks.gospa);
  ASSERT_TRUE(e.association);
  EXPECT_FALSE(e.association->correct || e.association->wrong);
  EXPECT_EQ(e.association->created, 1);
  EXPECT_EQ(e.association->rejected, 1);
  EXPECT_EQ(e.align, Align::kNone);
}

TEST(Evaluate, MatchesUnnamedLandmarksByDistance)
{
  PerfectRun run(2);
  run.record.hasMap = true;
  run.record.landmarks = {landmark(1, 0, 0.1), landmark(2, 5, 5), landmark(3, 9, 9)};
  run.record.pairings = {pairing(1, 0, kNew, 1)};
  run.truth.landmarks = {{1, {5, 5.2}}, {2, {0, 0}}, {3, {-7, 0}}};
  const Evaluation e = evaluate(run.record, run.truth, {});
  ASSERT_EQ(e.landmarks.matches.size(), 2u);
  EXPECT_EQ(e.landmarks.matches[0].truthId, 2);
  EXPECT_EQ(e.landmarks.matches[1].truthId, 1);
  EXPECT_EQ(e.landmarks.mapped, 3);
  EXPECT_EQ(e.landmarks.trueOnes, 2);
  EXPECT_NEAR(*e.landmarks.rmse, std::sqrt((0.01 + 0.04) / 2), 1e-12);
  EXPECT_NEAR(e.landmarks.gospa->total, std::sqrt(0.05 + 0.5 + 0.5), 1e-12);
}

TEST(Evaluate, MatchesNamedLandmarksByTheirIdentity)
{
  PerfectRun run(2);
  run.record.hasMap = true;
  run.record.landmarks = {landmark(1, 0, 0), landmark(2, 1, 0)};
  run.record.pairings = {pairing(1, 0, kNew, 1, 1), pairing(1, 1, kNew, 2, 2)};
  run.truth.landmarks = {{1, {1, 0}}, {2, {0, 0}}};  // swapped
  const Evaluation e = evaluate(run.record, run.truth, {});
  EXPECT_NEAR(*e.landmarks.rmse, 1.0, 1e-12);
  EXPECT_NEAR(e.landmarks.gospa->total, 0.0, 1e-12);
}

TEST(Evaluate, CountsAssociationsByMostSightings)
{
  PerfectRun run(2);
  // Landmark 0 is true 7 but once took a sighting of 8 and once clutter; landmark 1 is clutter.
  run.record.pairings = {pairing(1, 0, kNew, 0),      pairing(1, 1, kNew, 1),
                         pairing(2, 0, kKnown, 0),    pairing(2, 1, kKnown, 1),
                         pairing(3, 0, kKnown, 0),    pairing(3, 1, kKnown, 0),
                         pairing(3, 2, kRejected, -1)};
  run.truth.associations = {{1, 0, 7}, {1, 1, -1}, {2, 0, 7}, {2, 1, -1},
                            {3, 0, 8}, {3, 1, -1}, {3, 2, 9}};
  const auto counts = evaluate(run.record, run.truth, {}).association;
  ASSERT_TRUE(counts);
  EXPECT_EQ(counts->correct, 1);
  EXPECT_EQ(counts->wrong, 3);
  EXPECT_EQ(counts->created, 2);
  EXPECT_EQ(counts->rejected, 1);
}

TEST(Evaluate, CountsAssociationsByTheSensorsIdentities)
{
  PerfectRun run(2);
  run.record.pairings = {pairing(1, 0, kNew, 0, 7), pairing(2, 0, kKnown, 0, 7),
                         pairing(2, 1, kKnown, 0, 8)};
  const auto counts = evaluate(run.record, run.truth, {}).association;
  ASSERT_TRUE(counts);
  EXPECT_EQ(counts->correct, 1);
  EXPECT_EQ(counts->wrong, 1);
}

TEST(Evaluate, OfAFilterThatPairsNothingHasNoCounts)
{
  PerfectRun run(2);
  const Evaluation e = evaluate(run.record, run.truth, {});
  EXPECT_FALSE(e.association);
  EXPECT_FALSE(e.landmarks.mapped);
}
}  // namespace slamot::eval
