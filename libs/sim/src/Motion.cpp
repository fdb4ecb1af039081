#include <slamot/sim/Motion.h>

namespace slamot::sim
{
namespace
{
Motion::Kind readKind(core::Params& p)
{
  const std::string kind = p.choice(
      "motion", {"circle", "waypoints", "straight", "manoeuvre", "command", "accelerated"});
  if (kind == "circle") return Motion::Kind::kCircle;
  if (kind == "waypoints") return Motion::Kind::kWaypoints;
  if (kind == "straight") return Motion::Kind::kStraight;
  if (kind == "accelerated") return Motion::Kind::kAccelerated;
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
}

void readNoise(core::Params& p, Motion& m)
{
  // A point has no wheels: its jerk is all that is random.
  const bool isPoint = m.kind == Motion::Kind::kAccelerated;
  const auto otherwise = isPoint ? std::optional(0.0) : std::nullopt;
  m.vStd = p.nonNegative("v_std_mps", otherwise);
  m.omegaStd = p.nonNegative("omega_std_radps", otherwise);
  if (isPoint && (m.vStd > 0 || m.omegaStd > 0))
    p.fail(m.vStd > 0 ? "v_std_mps" : "omega_std_radps", "is not for motion = accelerated",
           "set it to 0, and jerk_noise_mps3_per_sqrt_hz");
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
  readNoise(p, m);
  return m;
}
}  // namespace slamot::sim
