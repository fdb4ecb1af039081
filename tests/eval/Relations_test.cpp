#include <gtest/gtest.h>
#include <slamot/eval/Evaluation.h>

#include "testRuns.h"

namespace slamot::eval
{
namespace
{
/// Relations between poses of the run's truth, as many as there are pairs that far apart.
std::vector<Relation> relationsOf(const Truth& truth, std::size_t apart)
{
  std::vector<Relation> out;
  const auto& poses = truth.robot.poses;
  for (std::size_t i = 0; i + apart < poses.size(); ++i)
    out.push_back({poses[i].time, poses[i + apart].time,
                   math::between(poses[i].pose, poses[i + apart].pose)});
  return out;
}

Trajectory pathOf(const Record& record)
{
  Trajectory out;
  for (const RobotRow& row : record.rows) out.poses.push_back({row.time, row.robot.mean, true});
  return out;
}

TEST(Relations, OfATruePathHaveNoErrorWhereverItLies)
{
  PerfectRun run(20);
  run.moveMap({30, -20, 2});
  for (const std::size_t apart : {1, 7})
  {
    const auto errors = evaluateRelations(pathOf(run.record), relationsOf(run.truth, apart));
    ASSERT_TRUE(errors);
    EXPECT_EQ(errors->count, 20 - static_cast<int>(apart));
    EXPECT_NEAR(*errors->translationMean, 0, 1e-12);
    EXPECT_NEAR(*errors->rotationMean, 0, 1e-12);
  }
}

TEST(Relations, TellHowFarAndByWhatAngleAPathIsOff)
{
  // From the origin to (3, 4) facing left; the reference says (3, 0) facing right.
  const Trajectory path{{{1, {0, 0, 0}, true}, {2, {3, 4, 3}, true}}};
  const auto errors = evaluateRelations(path, {{1, 2, {3, 0, -3}}});
  EXPECT_EQ(errors->count, 1);
  EXPECT_NEAR(*errors->translationMean, 4, 1e-12);
  EXPECT_NEAR(*errors->rotationMean, math::kTwoPi - 6, 1e-12) << "the short way round";
  // Both ways round, and their mean.
  const auto both = evaluateRelations(
      path, {{1, 2, {3, 4, 2}}, {2, 1, math::between(Pose2D(3, 4, 3), Pose2D())}});
  EXPECT_EQ(both->count, 2);
  EXPECT_NEAR(*both->translationMean, 0, 1e-12);
  EXPECT_NEAR(*both->rotationMean, 0.5, 1e-12);
}

TEST(Relations, CountOnlyWhereBothTimesAreThoseOfPoses)
{
  const Trajectory path{{{1, {0, 0, 0}, true}, {1.0004, {5, 0, 0}, true}, {2, {6, 0, 0}, true}}};
  const auto errors = evaluateRelations(
      path, {{1.0003, 2.0004, {0, 0, 0}}, {1, 2.0006, {}}, {0, 2, {}}, {1, 3, {}}, {1.5, 2, {}}});
  EXPECT_EQ(errors->count, 1);
  EXPECT_NEAR(*errors->translationMean, 1, 1e-12) << "from the pose that is nearest in time";
  EXPECT_EQ(evaluateRelations(path, {{1.5, 2, {}}}, 0.6)->count, 1);

  const auto none = evaluateRelations(path, {{7, 8, {}}});
  ASSERT_TRUE(none);
  EXPECT_EQ(none->count, 0);
  EXPECT_FALSE(none->translationMean || none->rotationMean);
  EXPECT_FALSE(evaluateRelations(path, {}));
  EXPECT_EQ(evaluateRelations(Trajectory(), {{7, 8, {}}})->count, 0);
}

TEST(Relations, OfARunAreOfTheRobotItself)
{
  PerfectRun run(20);
  run.truth.relations = relationsOf(run.truth, 3);
  EvaluationOptions options;
  EXPECT_NEAR(*evaluate(run.record, run.truth, options).relations->translationMean, 0, 1e-12);
  options.leverArm = {2, 1};
  EXPECT_NEAR(*evaluate(run.record, run.truth, options).relations->translationMean, 0, 1e-12);
  run.truth.relations.clear();
  EXPECT_FALSE(evaluate(run.record, run.truth, options).relations);
}

TEST(Relations, OfTheFinalPathAreGivenBesideThoseOfTheEstimates)
{
  PerfectRun run(20);
  run.truth.relations = relationsOf(run.truth, 3);
  EvaluationOptions options;
  for (const Point2D arm : {Point2D(0, 0), Point2D(2, 1)})
  {
    options.leverArm = arm;
    run.record.path = {};
    EXPECT_FALSE(evaluate(run.record, run.truth, options).pathRelations);
    run.record.path = pathOf(run.record);
    for (TimedPose& p : run.record.path.poses) p.pose.x *= 1.5;
    const auto e = evaluate(run.record, run.truth, options);
    EXPECT_EQ(e.pathRelations->count, e.relations->count);
    EXPECT_NEAR(*e.relations->translationMean, 0, 1e-12);
    EXPECT_GT(*e.pathRelations->translationMean, 0.01);
  }
}
}  // namespace
}  // namespace slamot::eval
