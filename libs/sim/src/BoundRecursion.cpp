#include "BoundRecursion.h"

#include <cmath>

#include "starts.h"

namespace slamot::sim
{
namespace
{
constexpr double kUnknownHeading = math::kPi / 1.7320508075688772;  // of any direction alike [rad]

Eigen::MatrixXd startCovariance(const StartKnowledge& knowledge)
{
  Vector3 std(kUnknownPlace, kUnknownPlace, kUnknownHeading);
  if (knowledge.known) std = {knowledge.std[0], knowledge.std[1], knowledge.std[2]};
  return std.cwiseAbs2().asDiagonal();
}
}  // namespace

double BoundRecursion::MeanSquare::root() const
{
  return std::sqrt(sum / count);
}

BoundRecursion::BoundRecursion(const Scenario& scenario, std::uint64_t seed, int robots)
    : scenario_(scenario),
      seed_(seed),
      landmarks_(placeLandmarks(scenario, seed)),
      bodies_(scenario, seed, true)
{
  for (int r = 0; r < robots; ++r) addRobot(r);
  for (const auto& [id, setup] : scenario.targets) addTarget(id, setup);
  recordErrors();
}

void BoundRecursion::addRobot(int index)
{
  // Without a known start, the map's frame is that of the start.
  const StartKnowledge& start = scenario_.robots[std::size_t(index)].start;
  const Eigen::MatrixXd cov =
      start.known ? startCovariance(start) : Eigen::MatrixXd(Matrix3::Zero());
  robots_.push_back({covariance_.add(cov), {}, {}});
}

void BoundRecursion::addTarget(int id, const TargetSetup& setup)
{
  StartKnowledge start = setup.start;
  start.known = start.known && setup.isPresent(0);
  Eigen::MatrixXd cov = startCovariance(start);
  if (const AcceleratedPoint* point = bodies_.point(id))
    cov = point->startStd(start).cwiseAbs2().asDiagonal();
  // Each robot is told with an error of its own.
  if (start.known) cov /= static_cast<double>(robots_.size());
  targets_[id] = {covariance_.add(cov), start.known, {}};
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

double BoundRecursion::placeVariance(int at) const
{
  return covariance_.variance(at) + covariance_.variance(at + 1);
}

void BoundRecursion::recordErrors()
{
  for (Robot& robot : robots_)
  {
    robot.position.add(placeVariance(robot.at));
    robot.heading.add(covariance_.variance(robot.at + 2));
  }
  const auto present = bodies_.presentTargets();
  for (auto& [id, target] : targets_)
    if (target.begun && present.count(id)) target.position.add(placeVariance(target.at));
}

PosteriorBound BoundRecursion::result() const
{
  PosteriorBound out;
  for (const Robot& robot : robots_)
    out.robots.push_back({robot.position.root(), robot.heading.root()});
  MeanSquare map;
  for (const auto& [id, at] : landmarkAt_) map.add(placeVariance(at));
  if (map.count > 0) out.map = map.root();
  for (const auto& [id, target] : targets_)
    if (target.position.count > 0) out.targets[id] = target.position.root();
  return out;
}
}  // namespace slamot::sim
