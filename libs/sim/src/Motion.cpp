#include <slamot/sim/Motion.h>

#include <algorithm>
#include <limits>

namespace slamot::sim
{
namespace
{
Motion::Kind readKind(core::Params& p)
{
  const std::string kind = p.choice("motion", {"circle", "waypoints", "straight", "manoeuvre",
                                               "command", "accelerated", "white_acceleration"});
  if (kind == "circle") return Motion::Kind::kCircle;
  if (kind == "waypoints") return Motion::Kind::kWaypoints;
  if (kind == "straight") return Motion::Kind::kStraight;
  if (kind == "accelerated") return Motion::Kind::kAccelerated;
  if (kind == "white_acceleration") return Motion::Kind::kWhiteAcceleration;
  return kind == "manoeuvre" ? Motion::Kind::kManoeuvre : Motion::Kind::kCommand;
}

void readStart(core::Params& p, Motion& m)
{
  const std::string at = p.choice("start", {"path", "given", "random", "near_target"}, "path");
  // Read whether used or not, so that --set can change from one way of starting to another.
  const auto x = p.optionalNumber("start_x_m"), y = p.optionalNumber("start_y_m");
  m.start = {x.value_or(0), y.value_or(0), p.number("start_theta_deg", 0.0)};
  m.startDistance = p.positive("start_distance_m", m.startDistance);
  m.startAt = at == "path"     ? Motion::StartAt::kPath
              : at == "given"  ? Motion::StartAt::kGiven
              : at == "random" ? Motion::StartAt::kRandom
                               : Motion::StartAt::kNearTarget;
  if (at == "given" && !(x && y))
    p.fail("start", "given, but where is not", "set start_x_m and start_y_m");
  if (at == "path" && m.kind != Motion::Kind::kCircle && m.kind != Motion::Kind::kWaypoints)
    p.fail("start", "path, but only circle and waypoints have one", "set start = given or random");
}

void readWaypoints(core::Params& p, Motion& m)
{
  m.loop = p.flag("waypoints_loop", m.loop);
  m.reached = p.positive("waypoint_reached_m", m.reached);
  if (m.kind != Motion::Kind::kWaypoints && !p.has("waypoints_m")) return;
  const auto numbers = p.numbers("waypoints_m");
  if (numbers.size() % 2 != 0 || numbers.size() < 4)
    p.fail("waypoints_m", "is not a list of two or more points", "write x1, y1, x2, y2, ...");
  for (std::size_t i = 0; i < numbers.size(); i += 2)
    m.waypoints.emplace_back(numbers[i], numbers[i + 1]);
}

void readCircle(core::Params& p, Motion& m, const Area& area)
{
  m.centre.x = p.number("circle_centre_x_m", area.centre().x);
  m.centre.y = p.number("circle_centre_y_m", area.centre().y);
  m.radius = p.positive("circle_radius_m", m.radius);
  m.clockwise = p.flag("circle_clockwise", m.clockwise);
  m.phase = p.optionalNumber("circle_phase_deg");
}

void readManoeuvre(core::Params& p, Motion& m)
{
  m.switchMin = p.positive("switch_min_s", m.switchMin);
  m.switchMax = p.positive("switch_max_s", m.switchMax);
  if (m.switchMax < m.switchMin) p.fail("switch_max_s", "is below switch_min_s", "raise it");
  m.border = p.nonNegative("border_m", m.border);
}

void readAcceleration(core::Params& p, Motion& m)
{
  const bool used = m.kind == Motion::Kind::kAccelerated;
  const auto unless = [used](double otherwise)
  { return used ? std::nullopt : std::optional(otherwise); };
  m.jerkNoise = p.nonNegative("jerk_noise_mps3_per_sqrt_hz", unless(0));
  m.speedBand = p.positive("speed_band_mps", unless(m.speedBand));
  m.cone = p.inRange("direction_cone_deg", 0.01, 89, unless(m.cone));
  if (used && m.speedBand >= m.speed)
    p.fail("speed_band_mps", "lets it stand still or turn back", "set it below speed_mps");
  const bool isWhite = m.kind == Motion::Kind::kWhiteAcceleration;
  m.accelerationStd =
      p.nonNegative("acceleration_std_mps2", isWhite ? std::nullopt : std::optional(0.0));
}

// Read whether used or not, so that --set can change from one drive to the other.
void readDrive(core::Params& p, Motion& m)
{
  const bool steers = p.choice("drive", {"turn_rate", "steering"}, "turn_rate") == "steering";
  m.drive = steers ? Motion::Drive::kSteering : Motion::Drive::kTurnRate;
  m.wheelBase = p.positive("wheel_base_m", m.wheelBase);
  m.steerMax = p.inRange("steer_max_deg", 0.1, 80, math::degToRad(30));
  m.steerRateMax = p.positive("steer_rate_max_deg_per_s", math::degToRad(20));
  m.steerStd = p.nonNegative("steer_std_deg", steers ? std::nullopt : std::optional(0.0));
  if (steers && m.kind != Motion::Kind::kWaypoints && m.kind != Motion::Kind::kStraight)
    p.fail("drive", "steering is for motion = waypoints and straight", "set it to turn_rate");
}

void readNoise(core::Params& p, Motion& m)
{
  // A point has no wheels: its jerk or acceleration is all that is random.
  const bool isPoint = m.isPoint();
  const auto otherwise = isPoint ? std::optional(0.0) : std::nullopt;
  m.vStd = p.nonNegative("v_std_mps", otherwise);
  const bool turns = m.drive == Motion::Drive::kTurnRate;
  m.omegaStd = p.nonNegative("omega_std_radps", turns ? otherwise : std::optional(0.0));
  if (isPoint && (m.vStd > 0 || m.omegaStd > 0))
    p.fail(m.vStd > 0 ? "v_std_mps" : "omega_std_radps", "is not for motion = " + p.text("motion"),
           "set it to 0, and jerk_noise_mps3_per_sqrt_hz or acceleration_std_mps2");
}
}  // namespace

Motion Motion::from(core::Params& p, const Area& area)
{
  Motion m;
  m.kind = readKind(p);
  m.speed = p.nonNegative("speed_mps");
  m.turnRate = p.number("turn_rate_radps", 0.0);
  m.turnGain = p.positive("turn_gain_per_s", m.turnGain);
  m.turnMax = p.positive("turn_max_radps", m.turnMax);
  readCircle(p, m, area);
  readWaypoints(p, m);
  readManoeuvre(p, m);
  readStart(p, m);
  readAcceleration(p, m);
  readDrive(p, m);
  readNoise(p, m);
  return m;
}

bool Motion::hasPath() const
{
  return kind == Kind::kCircle || kind == Kind::kWaypoints;
}

double Motion::distanceToPath(const Point2D& p) const
{
  if (kind == Kind::kCircle) return std::abs((p - centre).norm() - radius);
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = loop ? 0 : 1; i < waypoints.size(); ++i)
  {
    const Point2D& a = waypoints[i == 0 ? waypoints.size() - 1 : i - 1];
    const Point2D along = waypoints[i] - a, to = p - a;
    const double length2 = along.sqrNorm();
    const double t = length2 > 0 ? (to.x * along.x + to.y * along.y) / length2 : 0;
    nearest = std::min(nearest, (to - along * std::clamp(t, 0.0, 1.0)).norm());
  }
  return nearest;
}
}  // namespace slamot::sim
