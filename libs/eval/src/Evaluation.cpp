#include <slamot/eval/Alignment.h>
#include <slamot/eval/Evaluation.h>

#include <algorithm>

#include "poseErrors.h"

namespace slamot::eval
{
namespace
{
RobotEvaluation evaluateRobot(const Record& record, const Truth& truth,
                              const EvaluationOptions& options, const Pose2D& truthFromMap)
{
  RobotEvaluation out;
  for (std::size_t i = 0; i < record.rows.size(); ++i)
    if (const auto t = truth.robot.at(record.rows[i].time, options.maxTruthGap))
      out.steps.push_back(poseError(i, record.rows[i].robot, *t, truthFromMap));
  out.all = summarise(out.steps);
  out.atScans = summarise(out.steps, [&](const StepError& s) { return record.rows[s.row].scan; });
  return out;
}

/// \param alignments as asked for, and rigid.
RigidEvaluation evaluateRigid(const Record& record, const Truth& truth,
                              const EvaluationOptions& options,
                              const std::vector<Pose2D>& alignments)
{
  RigidEvaluation out;
  out.truthFromMap = alignments.back();
  out.robot = evaluateRobot(record, truth, options, out.truthFromMap).all;
  out.targetSet = evaluateTargetSet(record, truth, options, out.truthFromMap);
  out.truthFromLandmarks = alignMap(record, truth, options.gospaCutoff, alignments);
  out.landmarks = evaluateLandmarks(record, truth, options, out.truthFromLandmarks);
  return out;
}

/// True targets that no track stands for, where no track has taken their id.
void addMissed(Evaluation& evaluation)
{
  const auto tracks = evaluation.targets;
  for (const TargetEvaluation& truth : evaluation.trueTargets)
    if (std::none_of(tracks.begin(), tracks.end(),
                     [&](const TargetEvaluation& t)
                     { return t.truthId == truth.id || t.id == truth.id; }))
      evaluation.targets.push_back(truth);
}
}  // namespace

void evaluateItself(const Record& record, const Truth& truth, Evaluation& evaluation)
{
  evaluation.relations = evaluateRelations(record, truth.relations);
  evaluation.pathRelations.reset();
  if (!record.path.empty())
    evaluation.pathRelations = evaluateRelations(record.path, truth.relations);
  evaluation.scanMap = scanMapQuality(record);
}

Evaluation evaluate(const Record& record, const Truth& truth, const EvaluationOptions& options,
                    const Pose2D& truthFromMap, const std::optional<Pose2D>& rigid)
{
  if (options.leverArm != Point2D())
  {
    EvaluationOptions there = options;
    there.leverArm = {};
    Evaluation out = evaluate(ofPoint(record, options.leverArm), truth, there, truthFromMap, rigid);
    evaluateItself(record, truth, out);
    return out;
  }
  Evaluation out;
  out.align = options.align;
  out.truthFromMap = truthFromMap;
  out.robot = evaluateRobot(record, truth, options, truthFromMap);
  out.targets = evaluateTracks(record, truth, options, truthFromMap);
  out.trueTargets = evaluateTrueTargets(record, truth, options, truthFromMap, out.targets);
  addMissed(out);
  out.targetSet = evaluateTargetSet(record, truth, options, truthFromMap);
  out.landmarks = evaluateLandmarks(record, truth, options, truthFromMap);
  out.association = countAssociations(record, truth);
  evaluateItself(record, truth, out);
  if (rigid) out.rigid = evaluateRigid(record, truth, options, {truthFromMap, *rigid});
  return out;
}

Evaluation evaluate(const Record& record, const Truth& truth, const EvaluationOptions& options)
{
  return evaluateTogether({{&record, &truth}}, options).front();
}
}  // namespace slamot::eval
