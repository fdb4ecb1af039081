#include <gtest/gtest.h>
#include <slamot/eval/Alignment.h>
#include <slamot/eval/Evaluation.h>
#include <slamot/math/random.h>

#include <cmath>

#include "testRuns.h"

namespace slamot::eval
{
namespace
{
using Outcome = core::Pairing::Outcome;

PairingRow pairing(double time, int index, Outcome outcome, int id)
{
  return {time, {false, index, outcome, id}, core::kNoId};
}

core::LandmarkEstimate landmark(int id, const Point2D& at)
{
  core::LandmarkEstimate m;
  m.id = id;
  m.position.mean = at;
  m.position.cov = 0.01 * Matrix2::Identity();
  m.sightings = 2;
  return m;
}

TargetTrack track(int id, const std::vector<std::pair<std::size_t, Point2D>>& rows)
{
  TargetTrack out;
  out.id = id;
  for (const auto& [row, p] : rows)
  {
    TargetRow t;
    t.row = row;
    t.pose.mean = {p.x, p.y, 0};
    out.rows.push_back(t);
  }
  return out;
}

/// A run with a map of 30 landmarks, moved as a whole and each by a little.
struct MappedRun : PerfectRun
{
  explicit MappedRun(const Pose2D& moved) : PerfectRun(5)
  {
    math::RandomStream random{3};
    record.hasMap = true;
    for (int id = 0; id < 30; ++id)
    {
      const Point2D p(random.uniform(-40, 40), random.uniform(-40, 40));
      truth.landmarks[id] = p;
      const Point2D near(p.x + 0.1 * random.normal(), p.y + 0.1 * random.normal());
      record.landmarks.push_back(landmark(100 + id, math::transform(moved, near)));
      record.pairings.push_back(pairing(1, id, Outcome::kNew, 100 + id));
      truth.associations.push_back({1, id, id});
    }
  }
};

EvaluationOptions cutoff(double c)
{
  EvaluationOptions out;
  out.gospaCutoff = c;
  return out;
}
}  // namespace

TEST(Associations, AreCountedByWhatWasRightAndWrong)
{
  PerfectRun run(4);
  // Landmark 0 is true 7, landmark 1 too, landmark 2 is clutter.
  run.record.pairings = {
      pairing(1, 0, Outcome::kNew, 0),      pairing(1, 1, Outcome::kNew, 2),
      pairing(2, 0, Outcome::kKnown, 0),    pairing(2, 1, Outcome::kKnown, 2),
      pairing(2, 2, Outcome::kNew, 1),      pairing(3, 0, Outcome::kKnown, 1),
      pairing(3, 1, Outcome::kKnown, 0),    pairing(3, 2, Outcome::kRejected, -1),
      pairing(3, 3, Outcome::kRejected, -1)};
  run.truth.associations = {{1, 0, 7}, {1, 1, -1}, {2, 0, 7},  {2, 1, -1}, {2, 2, 7},
                            {3, 0, 7}, {3, 1, 8},  {3, 2, -1}, {3, 3, 9}};
  const auto a = evaluate(run.record, run.truth, {}).association;
  ASSERT_TRUE(a);
  EXPECT_EQ(a->correct, 2);
  EXPECT_EQ(a->wrong, 2);
  EXPECT_EQ(a->sightings, 6);
  EXPECT_EQ(a->founded, 1);  // the second landmark made of true 7 is one too many
  EXPECT_EQ(a->clutter, 3);
  EXPECT_EQ(a->clutterPaired, 1);
  EXPECT_DOUBLE_EQ(*a->rightOfPaired(), 2.0 / 4);
  EXPECT_DOUBLE_EQ(*a->rightOfSightings(), 3.0 / 6);
  EXPECT_DOUBLE_EQ(*a->pairedOfClutter(), 1.0 / 3);
}

TEST(Associations, WithoutTruthHaveNoShares)
{
  PerfectRun run(2);
  run.record.pairings = {pairing(1, 0, Outcome::kNew, 0), pairing(2, 0, Outcome::kKnown, 0)};
  const auto a = evaluate(run.record, run.truth, {}).association;
  ASSERT_TRUE(a);
  EXPECT_FALSE(a->correct || a->rightOfPaired() || a->rightOfSightings() || a->pairedOfClutter());
}

TEST(MapEvaluation, CountsTheLandmarksThatWereSeen)
{
  MappedRun run({});
  run.truth.associations.resize(12);
  run.truth.associations.push_back({2, 0, 3});
  run.truth.associations.push_back({2, 1, core::kNoId});
  EXPECT_EQ(evaluate(run.record, run.truth, {}).landmarks.seen, 12);
  run.truth.associations.clear();
  EXPECT_FALSE(evaluate(run.record, run.truth, {}).landmarks.seen);
}

TEST(MapEvaluation, RigidAlignmentUndoesAMovedMap)
{
  const MappedRun at({}), moved({7, -4, 0.3});
  const auto there = evaluate(at.record, at.truth, cutoff(2));
  const auto away = evaluate(moved.record, moved.truth, cutoff(2));
  EXPECT_GT(away.landmarks.gospa->total, 3 * there.landmarks.gospa->total);
  ASSERT_TRUE(away.rigid && there.rigid);
  EXPECT_NEAR(away.rigid->landmarks.gospa->total, there.rigid->landmarks.gospa->total, 1e-9);
  EXPECT_NEAR(away.rigid->landmarks.gospa->ospa, there.rigid->landmarks.gospa->ospa, 1e-9);
  EXPECT_NEAR(*away.rigid->landmarks.rmse, *there.rigid->landmarks.rmse, 1e-9);
  EXPECT_EQ(away.rigid->landmarks.gospa->missed, 0);
  // Least squares over all 30: two points an eighth of a landmark's deviation nearer, not more.
  EXPECT_LT(there.rigid->landmarks.gospa->localisation, there.landmarks.gospa->localisation);
  EXPECT_NEAR(away.rigid->truthFromLandmarks.phi, -0.3, 0.01);
}

TEST(MapEvaluation, AlignmentWithoutIdentitiesIsFoundFromTheStart)
{
  MappedRun run({0.6, -0.5, 0.03});
  run.truth.associations.clear();
  const auto e = evaluate(run.record, run.truth, cutoff(2));
  EXPECT_NEAR(e.rigid->truthFromLandmarks.phi, -0.03, 0.01);
  EXPECT_EQ(e.rigid->landmarks.gospa->missed, 0);
  EXPECT_LT(*e.rigid->landmarks.rmse, 0.2);
}

TEST(MapEvaluation, AlignmentNeverMakesGospaWorse)
{
  math::RandomStream random{8};
  for (int i = 0; i < 50; ++i)
  {
    MappedRun run({random.uniform(-5, 5), random.uniform(-5, 5), random.uniform(-1, 1)});
    run.record.landmarks.resize(10);
    for (int extra = 0; extra < 10; ++extra)  // false ones
      run.record.landmarks.push_back(
          landmark(extra, {random.uniform(-40, 40), random.uniform(-40, 40)}));
    if (i % 2 == 0) run.truth.associations.clear();
    const auto e = evaluate(run.record, run.truth, cutoff(5));
    EXPECT_LE(e.rigid->landmarks.gospa->total, e.landmarks.gospa->total) << i;
  }
}

TEST(MapEvaluation, WithoutTheRobotsTruthHasNoRigidPart)
{
  MappedRun run({});
  run.truth.robot.poses.clear();
  EXPECT_FALSE(evaluate(run.record, run.truth, {}).rigid);
}

TEST(TargetSet, ComparesWhatIsTrackedWithWhatIsThereAtScans)
{
  PerfectRun run(4);  // one row a second
  for (const int i : {1, 2}) run.record.rows[std::size_t(i)].scan = true;
  for (int i = 0; i < 4; ++i)
    run.truth.targets[1].poses.push_back({double(i), Pose2D(10, 10, 0), true});
  run.truth.targets[2].poses.push_back({2.0, Pose2D(-10, 10, 0), true});
  // At the first scan one of one, 0.3 m off; at the second one missed, one false.
  run.record.targets = {track(1, {{0, {99, 99}}, {1, {10.3, 10}}, {2, {10, 10}}}),
                        track(2, {{2, {50, 50}}})};
  const auto t = evaluate(run.record, run.truth, cutoff(2)).targetSet;
  ASSERT_TRUE(t);
  EXPECT_EQ(t->scans, 2);
  EXPECT_DOUBLE_EQ(t->estimated, 1.5);
  EXPECT_DOUBLE_EQ(t->truly, 1.5);
  EXPECT_NEAR(t->localisation, 0.09 / 2, 1e-12);
  EXPECT_NEAR(t->missed, 2.0 / 2, 1e-12);
  EXPECT_NEAR(t->falseOnes, 2.0 / 2, 1e-12);
  EXPECT_NEAR(t->gospa, (0.3 + 2) / 2, 1e-12);
  EXPECT_NEAR(t->ospa, (0.3 + std::sqrt(4.0 / 2)) / 2, 1e-12);
}

TEST(TargetSet, IsLaidOverTheTruthWithThePath)
{
  PerfectRun run(6);
  for (RobotRow& row : run.record.rows) row.scan = true;
  for (int i = 0; i < 6; ++i)
    run.truth.targets[1].poses.push_back({double(i), Pose2D(3, 4, 0), true});
  run.record.targets = {
      track(1, {{0, {3, 4}}, {1, {3, 4}}, {2, {3, 4}}, {3, {3, 4}}, {4, {3, 4}}, {5, {3, 4}}})};
  run.moveMap({20, 5, -0.7});
  const auto e = evaluate(run.record, run.truth, cutoff(5));
  EXPECT_NEAR(e.targetSet->gospa, 5, 1e-9);
  EXPECT_NEAR(e.rigid->targetSet->gospa, 0, 1e-6);
  EXPECT_NEAR(*e.rigid->robot.positionRmse, 0, 1e-6);
}

TEST(TargetSet, WithoutTrueTargetsIsNone)
{
  PerfectRun run(2);
  run.record.rows[1].scan = true;
  EXPECT_FALSE(evaluate(run.record, run.truth, {}).targetSet);
}
}  // namespace slamot::eval
