#include "Driver.h"

#include <slamot/models/RangeBearing.h>

#include <algorithm>

namespace slamot::sim
{
namespace
{
double steer(const Motion& m, double bearing)
{
  return std::clamp(m.turnGain * bearing, -m.turnMax, m.turnMax);
}
}  // namespace

Driver::Driver(const Motion& motion, const Area& area, const math::RandomStream& turns)
    : motion_(motion), area_(area), turns_(turns)
{
  // On the way to the second waypoint, if it starts at the first.
  if (motion.kind == Motion::Kind::kWaypoints && motion.startAt == Motion::StartAt::kPath)
    waypoint_ = 1;
}

Command Driver::next(const Pose2D& pose, double elapsed)
{
  switch (motion_.kind)
  {
    case Motion::Kind::kCircle:
      return {motion_.speed, (motion_.clockwise ? -1 : 1) * motion_.speed / motion_.radius};
    case Motion::Kind::kWaypoints:
      return toWaypoint(pose, elapsed);
    case Motion::Kind::kStraight:
      return {motion_.speed, 0};
    case Motion::Kind::kManoeuvre:
      return manoeuvre(pose, elapsed);
    case Motion::Kind::kCommand:
    case Motion::Kind::kAccelerated:  // are no bodies that are driven
    case Motion::Kind::kWhiteAcceleration:
      break;
  }
  return {motion_.speed, motion_.turnRate};
}

double Driver::turnWheel(double to, double elapsed)
{
  const double most = motion_.steerRateMax * (elapsed - wheelTime_);
  wheelTime_ = elapsed;
  wheel_ += std::clamp(math::wrapToPi(to - wheel_), -most, most);
  return wheel_ = std::clamp(wheel_, -motion_.steerMax, motion_.steerMax);
}

Command Driver::toWaypoint(const Pose2D& pose, double elapsed)
{
  const auto& points = motion_.waypoints;
  if (waypoint_ < points.size() &&
      models::RangeBearing::predict(pose, points[waypoint_])[0] < motion_.reached)
  {
    ++waypoint_;
    if (motion_.loop) waypoint_ %= points.size();
  }
  if (waypoint_ >= points.size()) return {};
  const double bearing = models::RangeBearing::predict(pose, points[waypoint_])[1];
  if (motion_.drive == Motion::Drive::kSteering)
    return {motion_.speed, turnWheel(bearing, elapsed)};
  // Slower in sharp turns: at full speed it could circle a waypoint for ever.
  return {motion_.speed * std::max(0.0, std::cos(bearing)), steer(motion_, bearing)};
}

Command Driver::manoeuvre(const Pose2D& pose, double elapsed)
{
  if (elapsed >= nextSwitch_)
  {
    // The first turn goes either way, later ones the other way.
    turn_ = nextSwitch_ == 0 ? (turns_.uniform() < 0.5 ? -1 : 1) : -turn_;
    nextSwitch_ = elapsed + turns_.uniform(motion_.switchMin, motion_.switchMax);
  }
  const Point2D here{pose.x, pose.y};
  const bool straying = !area_.contains(here, motion_.border);
  const double home = models::RangeBearing::predict(pose, area_.centre())[1];
  if (straying && std::abs(home) > math::kPi / 4) turn_ = home > 0 ? 1 : -1;
  return {motion_.speed, turn_ * motion_.turnRate};
}

Command follow(const RobotSetup& setup, const Pose2D& robot, const Pose2D& target,
               double targetSpeed)
{
  const double left = setup.followSide;
  const Point2D aim{target.x - left * std::sin(target.phi), target.y + left * std::cos(target.phi)};
  const auto z = models::RangeBearing::predict(robot, aim);
  return {std::clamp(setup.followGain * (z[0] - setup.followDistance), 0.0,
                     setup.followSpeedRatio * targetSpeed),
          steer(setup.motion, z[1])};
}
}  // namespace slamot::sim
