#include "BoundRecursion.h"

#include <cmath>

#include "starts.h"

namespace slamot::sim
{
namespace
{
constexpr double kUnknownHeading = math::kPi / 1.7320508075688772;  // of any direction alike [rad]

Eigen::VectorXd startStd(const StartKnowledge& knowledge)
{
  if (!knowledge.known) return Vector3(kUnknownPlace, kUnknownPlace, kUnknownHeading);
  return Vector3(knowledge.std[0], knowledge.std[1], knowledge.std[2]);
}

/// What was told of a start, less the truth.
Vector3 robotError(const core::ObjectStart& told, const Pose2D& truth)
{
  const Pose2D pose = told.pose().mean;
  return {pose.x - truth.x, pose.y - truth.y, math::wrapToPi(pose.phi - truth.phi)};
}
}  // namespace

void BoundRecursion::Squares::add(const Squares& other)
{
  variance += other.variance;
  drawn += other.drawn;
  ++count;
}

PosteriorBound::Figure BoundRecursion::Squares::figure() const
{
  return {std::sqrt(variance / count), std::sqrt(drawn / count)};
}

BoundRecursion::BoundRecursion(const Scenario& scenario, std::uint64_t seed, int robots)
    : scenario_(scenario),
      seed_(seed),
      landmarks_(placeLandmarks(scenario, seed)),
      bodies_(scenario, seed, true)
{
  for (const SensorSetup* s :
       {&scenario.landmarkSensor, scenario.targetSensor ? &*scenario.targetSensor : nullptr,
        scenario.mateSensor ? &*scenario.mateSensor : nullptr})
    if (s && s->glint) scores_.emplace(s, LawScore(s->glint, s->bearingOnly ? 1 : 2));
  for (int r = 0; r < robots; ++r) addRobot(r);
  for (const auto& [id, setup] : scenario.targets) addTarget(id, setup);
  recordErrors();
}

void BoundRecursion::addRobot(int index)
{
  // Without a known start, the map's frame is that of the start.
  Vector3 std = Vector3::Zero(), error = Vector3::Zero();
  if (const StartKnowledge& start = scenario_.robots[std::size_t(index)].start; start.known)
  {
    std = startStd(start);
    error = robotError(*bodies_.starts(index).robot, bodies_.robot(index));
  }
  robots_.push_back({errors_.add(std.cwiseAbs2().asDiagonal().toDenseMatrix(), error), {}, {}});
}

void BoundRecursion::addTarget(int id, const TargetSetup& setup)
{
  StartKnowledge start = setup.start;
  start.known = start.known && setup.isPresent(0);
  Eigen::VectorXd std = bodies_.pointStartStd(id, start).value_or(startStd(start));
  // Each robot is told with an error of its own.
  if (start.known) std /= std::sqrt(static_cast<double>(robots_.size()));
  const int at =
      errors_.add(std.cwiseAbs2().asDiagonal().toDenseMatrix(), startErrors(id, start, std));
  targets_[id] = {at, start.known, {}};
}

Eigen::VectorXd BoundRecursion::startErrors(int id, const StartKnowledge& start,
                                            const Eigen::VectorXd& std) const
{
  if (start.known && bodies_.toldAsState(id))
  {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(std.size());
    for (int r = 0; r < static_cast<int>(robots_.size()); ++r)
      sum += bodies_.toldError(bodies_.starts(r).targets.at(id), id);
    return sum / static_cast<double>(robots_.size());
  }
  // Nothing is told, or of springs not in their own coordinates: as uncertain, by a draw of its
  // own.
  auto random = stream(seed_, Purpose::kBoundStart, 0, targetKey(id));
  Eigen::VectorXd out(std.size());
  for (double& e : out) e = random.normal();
  return out.cwiseProduct(std);
}

void BoundRecursion::step()
{
  (void)bodies_.move();
  for (std::size_t r = 0; r < robots_.size(); ++r)
    move(robots_[r].at, bodies_.robotTransition(static_cast<int>(r)));
  for (const auto& [id, target] : targets_) move(target.at, bodies_.targetTransition(id));
  if (bodies_.step() % scenario_.scanEvery == 0)
    for (int r = 0; r < static_cast<int>(robots_.size()); ++r) scan(r);
  recordErrors();
}

BoundRecursion::Squares BoundRecursion::squares(int at, int count) const
{
  Squares out;
  for (int i = at; i < at + count; ++i)
  {
    out.variance += errors_.variance(i);
    out.drawn += errors_.error(i) * errors_.error(i);
  }
  return out;
}

void BoundRecursion::recordErrors()
{
  for (Robot& robot : robots_)
  {
    robot.position.add(squares(robot.at, 2));
    robot.heading.add(squares(robot.at + 2, 1));
  }
  const auto present = bodies_.presentTargets();
  for (auto& [id, target] : targets_)
    if (target.begun && present.count(id)) target.position.add(squares(target.at, 2));
}

PosteriorBound BoundRecursion::result() const
{
  PosteriorBound out;
  for (const Robot& robot : robots_)
    out.robots.push_back({robot.position.figure(), robot.heading.figure()});
  Squares map;
  for (const auto& [id, at] : landmarkAt_) map.add(squares(at, 2));
  if (map.count > 0) out.map = map.figure();
  for (const auto& [id, target] : targets_)
    if (target.position.count > 0) out.targets[id] = target.position.figure();
  return out;
}
}  // namespace slamot::sim
