#include "Bodies.h"

#include "starts.h"

namespace slamot::sim
{
Bodies::Bodies(const Scenario& scenario, std::uint64_t seed)
    : scenario_(scenario),
      seed_(seed),
      robot_{{},
             {scenario.robot.motion, scenario.area, stream(seed, Purpose::kManoeuvre, 0, kRobot)}}
{
  const auto poses = placeTargets(scenario, seed);
  robot_.pose = placeRobot(scenario, poses, seed);
  for (const auto& [id, target] : scenario.targets)
    targets_.emplace(id, Body{poses.at(id),
                              {target.motion, scenario.area,
                               stream(seed, Purpose::kManoeuvre, 0, targetKey(id))}});
}

std::map<int, Pose2D> Bodies::presentTargets() const
{
  std::map<int, Pose2D> out;
  for (const auto& [id, body] : targets_)
    if (scenario_.targets.at(id).isPresent(elapsed())) out.emplace(id, body.pose);
  return out;
}

core::Starts Bodies::starts() const
{
  const auto draws = [&](std::uint64_t key)
  { return stream(seed_, Purpose::kStartKnowledge, 0, key); };
  core::Starts out;
  const RobotSetup& r = scenario_.robot;
  if (r.start.known) out.robot = knownStart(r.start, r.motion, robot_.pose, draws(kRobot));
  for (const auto& [id, pose] : presentTargets())
  {
    const TargetSetup& target = scenario_.targets.at(id);
    if (target.start.known)
      out.targets[id] = knownStart(target.start, target.motion, pose, draws(targetKey(id)));
  }
  return out;
}

Command Bodies::robotCommand()
{
  const RobotSetup& r = scenario_.robot;
  if (!r.following) return robot_.driver.next(robot_.pose, elapsed());
  const TargetSetup& target = scenario_.targets.at(r.followed);
  if (!target.isPresent(elapsed())) return {};
  return follow(r, robot_.pose, targets_.at(r.followed).pose, target.motion.speed);
}

Pose2D Bodies::moved(const Pose2D& pose, const Command& c, const Motion& m, std::uint64_t key) const
{
  auto random = stream(seed_, Purpose::kMotion, static_cast<std::uint64_t>(step_), key);
  const double v = c.v + m.vStd * random.normal();
  const double omega = c.omega + m.omegaStd * random.normal();
  return math::compose(pose, math::turnThenMove(v, omega, scenario_.dt, 0, 0).mean);
}

Gaussian<Pose2D> Bodies::move()
{
  // Follows where the target is now, not where it will be after this step.
  const Command command = robotCommand();
  const Motion& m = scenario_.robot.motion;
  robot_.pose = moved(robot_.pose, command, m, kRobot);
  for (auto& [id, body] : targets_)
    body.pose = moved(body.pose, body.driver.next(body.pose, elapsed()),
                      scenario_.targets.at(id).motion, targetKey(id));
  ++step_;
  return math::turnThenMove(command.v, command.omega, scenario_.dt, m.vStd, m.omegaStd);
}
}  // namespace slamot::sim
