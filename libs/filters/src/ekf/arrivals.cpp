#include "Map.h"

#include "relate.h"
#include "sighting/inView.h"

// The part of the map that hypotheses need: what a sighting may be of, and what exists.
namespace slamot::filters::ekf
{
namespace
{
// What was seen often and is missed this often, is gone all the same; what is less likely than that
// is not worth its place in the covariance.
constexpr double kMostExistence = 1 - 1e-5, kLeastExistence = 1e-3;
constexpr double kExactRange = 1e-3, kExactBearing = 1e-4;  // deviations [m], [rad]
}  // namespace

// Where nobody tells how far a sensor sees, it is as far as it has seen yet.
void Map::look(const core::LandmarkScan& scan)
{
  constexpr double kLeast = 0.1;
  const double untold = core::FieldOfView{}.rangeMax;
  fov_ = scan.fov;
  for (const core::Sighting& s : scan.sightings) farthest_ = std::max(farthest_, s.range);
  if (fov_.rangeMax >= untold) fov_.rangeMax = farthest_;
  fov_.rangeMax = std::max(fov_.rangeMax, fov_.rangeMin + kLeast);
  fov_.bearingMax = std::max(fov_.bearingMax, fov_.bearingMin + kLeast);
}

std::vector<Ray> Map::begin(int robot, const core::LandmarkScan& scan, double time)
{
  look(scan);
  keepInReach(robot, scan, time);
  scanNumber_ = nextNumber_;
  nextNumber_ += static_cast<int>(scan.sightings.size());
  missed_ = {};
  from_ = {belief_->x()[robot], belief_->x()[robot + 1]};
  for (Entry& e : entries_) e.seen = false;
  std::vector<Ray> rays;
  for (const core::Sighting& s : scan.sightings) rays.push_back(settings_->ray(s));
  return rays;
}

double Map::chanceToSee(int robot, const Eye& eye, int slot) const
{
  const int j = belief_->landmark(slot);
  const double dx = belief_->x()[j] - eye.x, dy = belief_->x()[j + 1] - eye.y;
  const double r = std::hypot(dx, dy), bearing = math::wrapToPi(std::atan2(dy, dx) - eye.phi);
  Innovation o;  // of a sighting without error, for the deviations of what is expected
  if (!relate(*belief_, robot, j, eye, Ray::of(r, bearing, kExactRange, kExactBearing), o))
    return 0.5 * settings_->arrival->detection;
  return settings_->arrival->detection *
         partInView(fov_, r, bearing, std::sqrt(o.s11), std::sqrt(o.s22));
}

// Hypotheses part over landmarks that exist, most likely.  A sighting that may be of one that most
// likely does not, or of nothing known, is taken for the former in one hypothesis: take() weighs
// how likely that was.
std::vector<Map::Alternative> Map::alternatives(int robot, const Ray& ray, double time) const
{
  const Eye eye = eyeOf(*belief_, robot);
  const ArrivalSettings& arrival = *settings_->arrival;
  const double fresh = arrival.newDensity(fov_);
  Eye from = eye;  // where first estimates put it
  from.x = from_.x;
  from.y = from_.y;
  std::vector<Alternative> out{{kNew, std::log(fresh), 1, fresh / arrival.detection, {}}};
  for (const auto& [slot, o, n] : possible(robot, eye, ray, time))
  {
    const Entry& e = entries_[static_cast<std::size_t>(slot)];
    if (e.seen) continue;
    const bool doubted = e.existence < kReported;
    const double density = std::exp(-0.5 * o.d2) / (math::kTwoPi * std::sqrt(o.det));
    if (doubted && density <= out.front().density) continue;
    const double missed = 1 - e.existence * chanceToSee(robot, eye, slot);
    const double weight = e.existence * arrival.detection * density / missed;
    Alternative a{slot, std::log(doubted ? weight + fresh : weight), missed, density,
                  rowsOf(robot, belief_->landmark(slot), o, ray, n)};
    if (settings_->firstEstimates) deriveAt(e.first, from, a.rows);
    if (doubted)
      out.front() = a;
    else
      out.push_back(a);
  }
  std::stable_sort(out.begin(), out.end(),
                   [](const auto& a, const auto& b) { return a.logWeight > b.logWeight; });
  const double least = out.front().logWeight + std::log(0.1 * arrival.least);
  out.erase(
      std::find_if(out.begin() + 1, out.end(), [&](const auto& a) { return a.logWeight < least; }),
      out.end());
  return out;
}

std::int32_t Map::take(int robot, const Ray& ray, std::size_t k, const Alternative& of, double time)
{
  const ArrivalSettings& arrival = *settings_->arrival;
  std::int32_t slot = of.thing;
  if (slot == kNew) start(robot, ray, scanNumber_ + static_cast<int>(k), time, from_, slot);
  Entry& e = entries_[static_cast<std::size_t>(slot)];
  e.seen = true;
  if (of.thing == kNew)
  {
    e.existence = std::min(kMostExistence, arrival.firstExistence());
    return slot;
  }
  missed_.times(of.missed);
  ++e.sightings;
  e.lastSeen = time;
  // It may be of something new all the same.
  const double fresh = arrival.newDensity(fov_);
  const double is =
      e.existence * (arrival.detection * of.density + (1 - arrival.detection) * fresh);
  e.existence = std::min(kMostExistence, is / (is + (1 - e.existence) * fresh));
  return slot;
}

double Map::miss(int robot, double time)
{
  const Eye eye = eyeOf(*belief_, robot);
  for (int s = 0; s < static_cast<int>(entries_.size()); ++s)
  {
    Entry& e = entries_[static_cast<std::size_t>(s)];
    if (e.sightings == 0 || e.seen || belief_->landmark(s) < 0) continue;
    const double seen = chanceToSee(robot, eye, s);
    if (seen <= 0) continue;
    const double missed = 1 - e.existence * seen;
    missed_.times(missed);
    e.existence *= (1 - seen) / missed;
    if (e.existence < kLeastExistence) forget(s);
  }
  forgetUnconfirmed(time);
  return missed_.log();
}
}  // namespace slamot::filters::ekf
