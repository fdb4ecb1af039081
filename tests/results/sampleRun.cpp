#include "sampleRun.h"

#include <slamot/math/random.h>

#include <cmath>

namespace slamot::results
{
namespace
{
Gaussian<Pose2D> estimateNear(const Pose2D& truth, double std, math::RandomStream& random,
                              Vector3& drift)
{
  drift = 0.97 * drift + 0.24 * std * random.normal3();
  Gaussian<Pose2D> g;
  g.mean = {truth.x + drift[0], truth.y + drift[1], truth.phi + 0.5 * drift[2]};
  g.cov = Vector3(std * std, std * std, 0.25 * std * std).asDiagonal();
  return g;
}

eval::StepError errorOf(std::size_t row, const Gaussian<Pose2D>& estimate, const Pose2D& truth)
{
  eval::StepError e;
  e.row = row;
  e.error = {estimate.mean.x - truth.x, estimate.mean.y - truth.y,
             math::wrapToPi(estimate.mean.phi - truth.phi)};
  e.headingKnown = true;
  e.nees = math::mahalanobisSquared(e.error, estimate.cov);
  e.neesPosition = math::mahalanobisSquared(e.error.head<2>(), estimate.cov.topLeftCorner<2, 2>());
  return e;
}

Pose2D onCircle(double radius, double angle)
{
  return {radius * std::cos(angle), radius * std::sin(angle),
          math::wrapToPi(angle + math::kPi / 2)};
}

void addSteps(SampleRun& run, std::size_t steps, math::RandomStream& random)
{
  eval::TargetTrack target;
  target.id = 1, target.label = "target", target.identified = true;
  eval::TargetEvaluation targetErrors;
  targetErrors.id = 1, targetErrors.truthId = 1;
  Vector3 robotDrift{0, 0, 0}, targetDrift{0, 0, 0}, odometryDrift{0, 0, 0};
  const double perStep = 2 * math::kPi / 320;
  for (std::size_t i = 0; i < steps; ++i)
  {
    const double time = 0.025 * static_cast<double>(i), angle = perStep * static_cast<double>(i);
    const Pose2D robot = onCircle(2.5, angle), ahead = onCircle(3.0, angle + 0.5);
    const double std = 0.02 + 0.01 * static_cast<double>(i % 8);
    odometryDrift += 0.01 * random.normal3();
    const Pose2D odometry{robot.x + odometryDrift[0], robot.y + odometryDrift[1], robot.phi};
    run.record.rows.push_back(
        {time, estimateNear(robot, std, random, robotDrift), odometry, i % 8 == 0});
    target.rows.push_back({i, estimateNear(ahead, 2 * std, random, targetDrift), {0, 0}, time});
    eval::StepRow step;
    step.time = time, step.known = 2;
    step.ess = 200.0 - 20.0 * static_cast<double>(i % 8), step.resampled = i % 8 == 7;
    run.record.steps.push_back(step);
    run.truth.robot.poses.push_back({time, robot, true});
    run.truth.targets[1].poses.push_back({time, ahead, true});
    run.evaluation.robot.steps.push_back(errorOf(i, run.record.rows[i].robot, robot));
    targetErrors.steps.push_back(errorOf(i, target.rows[i].pose, ahead));
  }
  run.record.targets = {target};
  run.evaluation.targets = {targetErrors};
  run.evaluation.trueTargets = {targetErrors};
}

void addLandmarks(SampleRun& run, math::RandomStream& random)
{
  run.record.hasMap = true;
  for (int id = 0; id < 20; ++id)
  {
    const Point2D truth{random.uniform(-5, 5), random.uniform(-5, 5)};
    run.truth.landmarks[id] = truth;
    core::LandmarkEstimate l;
    l.id = id, l.sightings = 10 + id;
    l.position.mean = {truth.x + 0.05 * random.normal(), truth.y + 0.05 * random.normal()};
    l.position.cov << 0.004, 0.002, 0.002, 0.003;
    run.record.landmarks.push_back(l);
  }
}
}  // namespace

SampleRun sampleRun(std::size_t steps)
{
  SampleRun run;
  math::RandomStream random{1};
  run.record.particles = 200;
  run.record.complete = true;
  run.record.observations = 3 * steps;
  addSteps(run, steps, random);
  addLandmarks(run, random);
  run.evaluation.robot.all.count = static_cast<int>(steps);
  run.evaluation.robot.all.positionMean = 0.0393;
  run.evaluation.robot.all.positionRmse = 0.0421;
  run.evaluation.robot.all.headingRmse = 0.0172;
  run.evaluation.robot.all.neesMean = 3.21;
  run.evaluation.robot.all.coverage95 = 0.934;
  run.evaluation.robot.atScans = run.evaluation.robot.all;
  run.evaluation.targets[0].all = run.evaluation.targets[0].atScans = run.evaluation.robot.all;
  run.evaluation.targets[0].trackedFraction = 1.0;
  run.evaluation.trueTargets = run.evaluation.targets;
  run.evaluation.landmarks.mapped = run.evaluation.landmarks.trueOnes = 20;
  run.evaluation.landmarks.rmse = 0.071;
  run.evaluation.association = eval::AssociationCounts{801, 3, 20, 4};
  return run;
}
}  // namespace slamot::results
