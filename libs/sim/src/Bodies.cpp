#include "Bodies.h"

#include "starts.h"

namespace slamot::sim
{
Bodies::Bodies(const Scenario& scenario, std::uint64_t seed, bool linearise)
    : scenario_(scenario), seed_(seed), linearise_(linearise)
{
  const auto poses = placeTargets(scenario, seed);
  for (int i = 0; i < static_cast<int>(scenario.robots.size()); ++i)
    robots_.push_back(makeBody(scenario.robots[std::size_t(i)].motion,
                               placeRobot(scenario, i, poses, seed), robotKey(i)));
  for (const auto& [id, target] : scenario.targets)
    targets_.emplace(id, makeBody(target.motion, poses.at(id), targetKey(id)));
}

Bodies::Body Bodies::makeBody(const Motion& motion, const Pose2D& pose, std::uint64_t key) const
{
  Body out{pose, {motion, scenario_.area, stream(seed_, Purpose::kManoeuvre, 0, key)}};
  if (motion.kind == Motion::Kind::kAccelerated) out.point = AcceleratedPoint(motion, pose);
  if (motion.kind == Motion::Kind::kWhiteAcceleration)
    out.point = WhiteAccelerationPoint(motion, pose);
  return out;
}

std::map<int, Pose2D> Bodies::presentTargets() const
{
  std::map<int, Pose2D> out;
  for (const auto& [id, body] : targets_)
    if (scenario_.targets.at(id).isPresent(elapsed())) out.emplace(id, body.pose);
  return out;
}

std::map<int, Point2D> Bodies::matesOf(int robot) const
{
  std::map<int, Point2D> out;
  for (int i = 0; i < static_cast<int>(robots_.size()); ++i)
    if (i != robot) out[i] = {this->robot(i).x, this->robot(i).y};
  return out;
}

core::Starts Bodies::starts(int robot) const
{
  const auto draws = [&](std::uint64_t key)
  { return stream(seed_, Purpose::kStartKnowledge, 0, robotKey(robot) + key); };
  core::Starts out;
  const RobotSetup& r = scenario_.robots[std::size_t(robot)];
  if (r.start.known) out.robot = knownStart(r.start, r.motion, this->robot(robot), draws(0));
  for (const auto& [id, pose] : presentTargets())
  {
    const TargetSetup& target = scenario_.targets.at(id);
    if (target.start.known)
      out.targets[id] = knownStart(target.start, target.motion, pose, draws(targetKey(id)));
  }
  return out;
}

Command Bodies::robotCommand(std::size_t robot)
{
  const RobotSetup& r = scenario_.robots[robot];
  Body& body = robots_[robot];
  if (!r.following) return body.driver.next(body.pose, elapsed());
  const TargetSetup& target = scenario_.targets.at(r.followed);
  if (!target.isPresent(elapsed())) return {};
  return follow(r, body.pose, targets_.at(r.followed).pose, target.motion.speed);
}

void Bodies::drive(Body& body, const Command& c, const Motion& m, std::uint64_t key) const
{
  auto random = stream(seed_, Purpose::kMotion, static_cast<std::uint64_t>(step_), key);
  Command executed = c;
  executed.v += m.vStd * random.normal();
  executed.turn +=
      (m.drive == Motion::Drive::kSteering ? m.steerStd : m.omegaStd) * random.normal();
  body.before = body.pose;
  body.told = increment(m, c, scenario_.dt).mean;
  body.executed = increment(m, executed, scenario_.dt);
  body.pose = math::compose(body.pose, body.executed.mean);
}

void Bodies::moveTarget(Body& body, const Motion& m, std::uint64_t key) const
{
  if (!body.point) return drive(body, body.driver.next(body.pose, elapsed()), m, key);
  auto random = stream(seed_, Purpose::kMotion, static_cast<std::uint64_t>(step_), key);
  std::visit(
      [&](auto& point)
      {
        typename std::decay_t<decltype(point)>::Linear linear;
        point.move(scenario_.dt, random, linearise_ ? &linear : nullptr);
        if (linearise_) body.linear = {linear.F, linear.Q, linear.w};
        body.pose = point.pose();
      },
      *body.point);
}

Transition Bodies::transition(const Body& body)
{
  if (body.point) return body.linear;
  Matrix3 F = Matrix3::Identity();
  F(0, 2) = -(body.pose.y - body.before.y);
  F(1, 2) = body.pose.x - body.before.x;
  const Matrix3 R = math::poseRotation(body.before.phi);
  const Pose2D expected = math::compose(body.before, body.told);
  const Vector3 w(body.pose.x - expected.x, body.pose.y - expected.y,
                  math::wrapToPi(body.pose.phi - expected.phi));
  return {F, R * body.executed.cov * R.transpose(), w};
}

Transition Bodies::robotTransition(int index) const
{
  return transition(robots_[std::size_t(index)]);
}

Transition Bodies::targetTransition(int id) const
{
  return transition(targets_.at(id));
}

std::optional<Vector2> Bodies::targetVelocity(int id) const
{
  const auto& point = targets_.at(id).point;
  if (!point) return std::nullopt;
  return std::visit([](const auto& p) { return p.velocity(); }, *point);
}

std::optional<Eigen::VectorXd> Bodies::pointStartStd(int id, const StartKnowledge& told) const
{
  const auto& point = targets_.at(id).point;
  if (!point) return std::nullopt;
  return std::visit([&](const auto& p) -> Eigen::VectorXd { return p.startStd(told); }, *point);
}

bool Bodies::toldAsState(int id) const
{
  // Springs are not told in their own coordinates.
  const auto& point = targets_.at(id).point;
  return !point || (std::holds_alternative<WhiteAccelerationPoint>(*point) &&
                    scenario_.targets.at(id).start.velocityStd);
}

Eigen::VectorXd Bodies::toldError(const core::ObjectStart& told, int id) const
{
  using S = core::ObjectStart;
  const Body& body = targets_.at(id);
  const double x = told.get(S::kX) - body.pose.x, y = told.get(S::kY) - body.pose.y;
  if (!body.point) return Vector3(x, y, math::wrapToPi(told.get(S::kTheta) - body.pose.phi));
  const Vector2 v = *targetVelocity(id);
  return Eigen::Vector4d(x, y, told.get(S::kVx) - v.x(), told.get(S::kVy) - v.y());
}

std::vector<Gaussian<Pose2D>> Bodies::move()
{
  std::vector<Gaussian<Pose2D>> odometry;
  for (std::size_t i = 0; i < robots_.size(); ++i)
  {
    // Follows where the target is now, not where it will be after this step.
    const Command command = robotCommand(i);
    const Motion& m = scenario_.robots[i].motion;
    drive(robots_[i], command, m, robotKey(static_cast<int>(i)));
    odometry.push_back(increment(m, command, scenario_.dt));
  }
  for (auto& [id, body] : targets_)
    moveTarget(body, scenario_.targets.at(id).motion, targetKey(id));
  ++step_;
  return odometry;
}
}  // namespace slamot::sim
