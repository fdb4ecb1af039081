#include "starts.h"

#include <slamot/core/Error.h>

#include <algorithm>

namespace slamot::sim
{
namespace
{
constexpr int kMostDraws = 10'000;

[[noreturn]] void noPlace(const Scenario& s, const std::string& key, const std::string& whose,
                          const std::string& mend)
{
  throw core::Error(core::ExitStatus::kConfig, s.name + " " + key, "leaves no place for " + whose,
                    mend);
}

Point2D drawPoint(const Area& area, double border, math::RandomStream& random)
{
  const double x = random.uniform(border, area.width - border);
  return {x, random.uniform(border, area.height - border)};
}

Pose2D pathStart(const Motion& m, math::RandomStream& random)
{
  if (m.kind == Motion::Kind::kWaypoints)
  {
    const Point2D &a = m.waypoints[0], &b = m.waypoints[1];
    return {a.x, a.y, std::atan2(b.y - a.y, b.x - a.x)};
  }
  const double phase = m.phase ? *m.phase : random.uniform(-math::kPi, math::kPi);
  return {m.centre.x + m.radius * std::cos(phase), m.centre.y + m.radius * std::sin(phase),
          math::wrapToPi(phase + (m.clockwise ? -1 : 1) * math::kPi / 2)};
}

Pose2D place(const Motion& m, const Area& area, math::RandomStream& random)
{
  if (m.startAt == Motion::StartAt::kPath) return pathStart(m, random);
  if (m.startAt == Motion::StartAt::kGiven) return m.start;
  const Point2D at = drawPoint(area, 0, random);
  return {at.x, at.y, random.uniform(-math::kPi, math::kPi)};
}

Pose2D placeFacing(const Pose2D& target, const Scenario& s, const RobotSetup& robot,
                   math::RandomStream& random)
{
  const double distance = robot.motion.startDistance;
  for (int i = 0; i < kMostDraws; ++i)
  {
    const double a = random.uniform(-math::kPi, math::kPi);
    const Point2D at{target.x - distance * std::cos(a), target.y - distance * std::sin(a)};
    if (s.area.contains(at)) return {at.x, at.y, a};
  }
  noPlace(s, "[" + robot.section + "] start_distance_m", "the robot inside the world", "lower it");
}
}  // namespace

std::map<int, Pose2D> placeTargets(const Scenario& s, std::uint64_t seed)
{
  std::map<int, Pose2D> out;
  for (const auto& [id, target] : s.targets)
  {
    auto random = stream(seed, Purpose::kStart, 0, targetKey(id));
    out[id] = place(target.motion, s.area, random);
  }
  return out;
}

Pose2D placeRobot(const Scenario& s, int robot, const std::map<int, Pose2D>& targets,
                  std::uint64_t seed)
{
  auto random = stream(seed, Purpose::kStart, 0, robotKey(robot));
  const RobotSetup& r = s.robots.at(static_cast<std::size_t>(robot));
  if (r.motion.startAt != Motion::StartAt::kNearTarget) return place(r.motion, s.area, random);
  const Pose2D& target = r.following ? targets.at(r.followed) : targets.begin()->second;
  return placeFacing(target, s, r, random);
}

core::ObjectStart knownStart(const StartKnowledge& knowledge, const Motion& motion,
                             const Pose2D& truth, math::RandomStream random)
{
  using S = core::ObjectStart;
  S out;
  const std::array<double, 3> values{truth.x, truth.y, truth.phi};
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    out.value[i] = values[i] + knowledge.std[i] * random.normal();
    out.std[i] = knowledge.std[i];
  }
  out.value[S::kTheta] = math::wrapToPi(*out.value[S::kTheta]);
  // A point's direction is that of its velocity, which may turn anywhere in a step.
  if (motion.kind == Motion::Kind::kWhiteAcceleration)
    out.value[S::kTheta] = out.std[S::kTheta] = std::nullopt;
  const auto tell = [&](S::Field x, double trueX, S::Field y, double trueY, double std)
  {
    out.value[x] = trueX + std * random.normal();
    out.value[y] = trueY + std * random.normal();
    out.std[x] = out.std[y] = std;
  };
  if (knowledge.velocityStd)
    tell(S::kVx, motion.speed * std::cos(truth.phi), S::kVy, motion.speed * std::sin(truth.phi),
         *knowledge.velocityStd);
  // What accelerates starts without acceleration.
  if (knowledge.accelerationStd) tell(S::kAx, 0, S::kAy, 0, *knowledge.accelerationStd);
  return out;
}
}  // namespace slamot::sim
