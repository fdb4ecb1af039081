#include <slamot/eval/Alignment.h>

#include <cmath>
#include <stdexcept>

#include "poseErrors.h"

namespace slamot::eval
{
namespace
{
Point2D mean(const std::vector<Point2D>& points)
{
  Point2D sum(0, 0);
  for (const Point2D& p : points) sum += p;
  return sum * (1.0 / static_cast<double>(points.size()));
}

std::optional<Pose2D> firstPose(const std::vector<RunWithTruth>& runs, double maxTruthGap)
{
  for (const RunWithTruth& run : runs)
    for (const RobotRow& row : run.record->rows)
    {
      const auto truth = run.truth->robot.at(row.time, maxTruthGap);
      if (truth && truth->headingKnown)
        return math::compose(truth->pose, math::between(row.robot.mean, Pose2D()));
    }
  return std::nullopt;
}

std::optional<Pose2D> rigid(const std::vector<RunWithTruth>& runs, double maxTruthGap)
{
  std::vector<Point2D> from, to;
  for (const RunWithTruth& run : runs)
    for (const RobotRow& row : run.record->rows)
      if (const auto truth = run.truth->robot.at(row.time, maxTruthGap))
      {
        from.emplace_back(row.robot.mean.x, row.robot.mean.y);
        to.emplace_back(truth->pose.x, truth->pose.y);
      }
  if (from.empty()) return std::nullopt;
  return rigidAlignment(from, to);
}

std::vector<Evaluation> evaluateAtPoint(std::vector<RunWithTruth> runs, EvaluationOptions options)
{
  std::vector<Record> moved;
  moved.reserve(runs.size());
  for (RunWithTruth& run : runs)
    run.record = &moved.emplace_back(ofPoint(*run.record, options.leverArm));
  options.leverArm = {};
  return evaluateTogether(runs, options);
}
}  // namespace

std::vector<std::string> alignNames()
{
  return {"none", "first-pose", "rigid"};
}

std::string nameOf(Align align)
{
  return alignNames()[static_cast<std::size_t>(align)];
}

std::optional<Align> alignNamed(const std::string& name)
{
  for (const Align align : {Align::kNone, Align::kFirstPose, Align::kRigid})
    if (nameOf(align) == name) return align;
  return std::nullopt;
}

Pose2D rigidAlignment(const std::vector<Point2D>& from, const std::vector<Point2D>& to)
{
  if (from.empty() || from.size() != to.size())
    throw std::invalid_argument("alignment needs as many points on both sides, at least one");
  const Point2D a = mean(from), b = mean(to);
  double dot = 0, cross = 0;
  for (std::size_t i = 0; i < from.size(); ++i)
  {
    const Point2D p = from[i] - a, q = to[i] - b;
    dot += p.x * q.x + p.y * q.y;
    cross += p.x * q.y - p.y * q.x;
  }
  const Pose2D turn(0, 0, std::atan2(cross, dot));
  const Point2D turned = math::transform(turn, a);
  return {b.x - turned.x, b.y - turned.y, turn.phi};
}

std::optional<Pose2D> alignment(const std::vector<RunWithTruth>& runs, Align align,
                                double maxTruthGap)
{
  switch (align)
  {
    case Align::kFirstPose:
      return firstPose(runs, maxTruthGap);
    case Align::kRigid:
      return rigid(runs, maxTruthGap);
    case Align::kNone:
      break;
  }
  return Pose2D();
}

std::vector<Evaluation> evaluateTogether(const std::vector<RunWithTruth>& runs,
                                         EvaluationOptions options)
{
  if (options.leverArm != Point2D())
  {
    auto atPoint = evaluateAtPoint(runs, options);
    for (std::size_t i = 0; i < runs.size(); ++i)
      evaluateItself(*runs[i].record, *runs[i].truth, atPoint[i]);
    return atPoint;
  }
  const auto truthFromMap = alignment(runs, options.align, options.maxTruthGap);
  const auto rigid = alignment(runs, Align::kRigid, options.maxTruthGap);
  if (!truthFromMap) options.align = Align::kNone;
  std::vector<Evaluation> out;
  for (const RunWithTruth& run : runs)
    out.push_back(
        evaluate(*run.record, *run.truth, options, truthFromMap.value_or(Pose2D()), rigid));
  return out;
}
}  // namespace slamot::eval
