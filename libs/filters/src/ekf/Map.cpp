#include "Map.h"

#include "JointCompatibility.h"
#include "relate.h"
#include "sighting/inView.h"

#include <set>
#include <tuple>

namespace slamot::filters::ekf
{
namespace
{
// What was seen often and is missed this often, is gone all the same; what is less likely than that
// is not worth its place in the covariance.
constexpr double kMostExistence = 1 - 1e-5, kLeastExistence = 1e-3;
constexpr double kExactRange = 1e-3, kExactBearing = 1e-4;  // deviations [m], [rad]
constexpr int kMostRejections = 3;  // in a row, and no fewer than the sightings before

/// The rows' derivatives as if the landmark were where it was first thought to be.  Derivatives at
/// ever new estimates make the filter believe that it learns of its heading in the map what no
/// sighting can tell; at first estimates, what can't be observed stays so: Huang, Mourikis,
/// Roumeliotis 2008.
void deriveAt(const Point2D& first, const Eye& eye, SightingRows& row)
{
  const Vector2 d(first.x - eye.x, first.y - eye.y);
  if (row.byRobot(0, 2) != 0 || row.byRobot(1, 2) != -1)  // near: in the frame of the ray
  {
    const double perMetre = row.byObject.row(1).norm();
    const Vector2 inFrame = row.byObject * d;
    row.byRobot.col(2) << inFrame[1] / perMetre, -inFrame[0] * perMetre;
    return;
  }
  const double q = d.squaredNorm(), r = std::sqrt(q);
  constexpr double kMin = models::RangeBearing::kSmallestRange;
  if (!(r >= kMin)) return;
  row.byObject << d[0] / r, d[1] / r, -d[1] / q, d[0] / q;
  row.byRobot.leftCols<2>() = -row.byObject;
}
}  // namespace

void Map::visit(const std::function<void(const core::LandmarkEstimate&)>& visitor) const
{
  std::vector<std::pair<int, int>> confirmed;  // id, slot
  for (std::size_t s = 0; s < entries_.size(); ++s)
    if (isConfirmed(entries_[s])) confirmed.emplace_back(entries_[s].id, static_cast<int>(s));
  std::sort(confirmed.begin(), confirmed.end());
  for (const auto& [id, slot] : confirmed)
    visitor({id, belief_->place(slot), entries_[static_cast<std::size_t>(slot)].sightings});
}

std::size_t Map::size() const
{
  return static_cast<std::size_t>(std::count_if(entries_.begin(), entries_.end(),
                                                [&](const Entry& e) { return isConfirmed(e); }));
}

bool Map::isInReach(int robot, const core::LandmarkScan& scan) const
{
  if (!belief_->isFocused()) return false;
  const auto& x = belief_->x();
  const double moved = std::hypot(x[robot] - centre_.x, x[robot + 1] - centre_.y);
  if (moved > 0.5 * settings_->localRadius) return false;
  if (settings_->association != Association::kKnown) return moved + reachOf(robot, scan) <= reach_;
  return std::all_of(scan.sightings.begin(), scan.sightings.end(),
                     [&](const core::Sighting& s)
                     {
                       const auto it = slotOf_.find(s.id);
                       return it == slotOf_.end() || belief_->landmark(it->second) >= 0;
                     });
}

// How far from where a sighting seems to be the landmark can be that it is of.
double Map::slack(int robot, const core::Sighting& s) const
{
  const Ray ray = settings_->ray(s);
  const auto& P = belief_->P();
  const double own =
      ray.varRange + ray.range * ray.range * (ray.varBearing + P(robot + 2, robot + 2));
  const double most = 2 * (largestVar_ + P(robot, robot) + P(robot + 1, robot + 1) + own);
  return std::sqrt(2 * settings_->gates.outer * most);
}

// How far away all is that, without identities, a scan's sightings may be of, or that should have
// been seen.
double Map::reachOf(int robot, const core::LandmarkScan& scan) const
{
  double reach = 0;
  for (const core::Sighting& s : scan.sightings) reach = std::max(reach, s.range + slack(robot, s));
  core::Sighting farthest;
  farthest.range = fov_.rangeMax;
  return settings_->arrival ? std::max(reach, farthest.range + slack(robot, farthest)) : reach;
}

void Map::keepInReach(int robot, const core::LandmarkScan& scan, double time)
{
  if (settings_->localRadius <= 0 || entries_.empty() || isInReach(robot, scan)) return;
  belief_->spread();
  forgetUnconfirmed(time);
  largestVar_ = 0;
  for (int s = 0; s < belief_->landmarks(); ++s)
  {
    const int j = belief_->landmark(s);
    largestVar_ = std::max(largestVar_, belief_->P()(j, j) + belief_->P()(j + 1, j + 1));
  }
  const auto& x = belief_->x();
  centre_ = {x[robot], x[robot + 1]};
  reach_ = settings_->localRadius;
  // Without identities, all that a sighting may be of must be local.
  if (settings_->association != Association::kKnown)
    reach_ = std::max(reach_, 1.5 * reachOf(robot, scan));
  std::set<int> local;
  for (const core::Sighting& s : scan.sightings)
    if (const auto it = slotOf_.find(s.id); it != slotOf_.end()) local.insert(it->second);
  for (int s = 0; s < belief_->landmarks(); ++s)
  {
    const int j = belief_->landmark(s);
    if (entries_[static_cast<std::size_t>(s)].sightings > 0 &&
        std::hypot(x[j] - centre_.x, x[j + 1] - centre_.y) <= reach_)
      local.insert(s);
  }
  belief_->focus({local.begin(), local.end()});
}

Map::Scan Map::match(int robot, const core::LandmarkScan& scan, double time,
                     std::vector<SightingRows>& rows)
{
  keepInReach(robot, scan, time);
  Scan out;
  for (const core::Sighting& s : scan.sightings) out.rays.push_back(settings_->ray(s));
  out.matches.assign(out.rays.size(), kNew);
  if (settings_->association == Association::kKnown)
    matchKnown(scan, out.matches);
  else
    matchByPlace(robot, time, out);
  const Eye eye = eyeOf(*belief_, robot);
  out.from = {eye.x, eye.y};
  for (std::size_t k = 0; k < out.rays.size(); ++k)
  {
    if (out.matches[k] < 0) continue;
    const int slot = out.matches[k], object = belief_->landmark(slot);
    const double n = noise(entries_[static_cast<std::size_t>(slot)], time);
    Innovation o;
    Entry& entry = entries_[static_cast<std::size_t>(slot)];
    if (relate(*belief_, robot, object, eye, out.rays[k], o, n) && o.d2 <= settings_->gates.outer)
    {
      rows.push_back(rowsOf(robot, object, o, out.rays[k], n));
      if (settings_->firstEstimates) deriveAt(entry.first, eye, rows.back());
      entry.rejections = 0;
      continue;
    }
    // One that is nowhere near what it says it is was misread; or those before were.
    out.matches[k] = kRejected;
    if (++entry.rejections < std::max(kMostRejections, entry.sightings)) continue;
    forget(slot);
    out.matches[k] = kNew;
  }
  return out;
}

void Map::matchKnown(const core::LandmarkScan& scan, std::vector<std::int32_t>& matches) const
{
  std::set<int> seen;
  for (std::size_t k = 0; k < matches.size(); ++k)
  {
    const int id = scan.sightings[k].id;
    const auto it = slotOf_.find(id);
    if (id == core::kNoId || !seen.insert(id).second)
      matches[k] = kRejected;
    else if (it != slotOf_.end())
      matches[k] = it->second;
  }
}

// f(slot, innovation, what multiplies the noise) for every local landmark that a sighting may be
// of.
template <class F>
void Map::forPossible(int robot, const Eye& eye, const Ray& ray, double time, F&& f) const
{
  const auto& x = belief_->x();
  const auto spread = [&](int j) { return belief_->P()(j, j) + belief_->P()(j + 1, j + 1); };
  const Point2D at = invert(eye, ray).mean;
  const double own =
      ray.varRange + ray.range * ray.range * (ray.varBearing + belief_->P()(robot + 2, robot + 2));
  for (int s = 0; s < belief_->landmarks(); ++s)
  {
    const Entry& entry = entries_[static_cast<std::size_t>(s)];
    const int j = belief_->landmark(s);
    if (j < 0 || entry.sightings == 0) continue;
    const double n = noise(entry, time), dx = x[j] - at.x, dy = x[j + 1] - at.y;
    // No covariance of a difference exceeds twice the sum of both.
    const double most = 2 * (spread(j) + spread(robot) + n * own);
    Innovation o;
    if (dx * dx + dy * dy <= 2 * settings_->gates.outer * most &&
        relate(*belief_, robot, j, eye, ray, o, n) && o.d2 <= settings_->gates.outer)
      f(s, o, n);
  }
}

void Map::matchByPlace(int robot, double time, Scan& out)
{
  const Eye eye = eyeOf(*belief_, robot);
  std::vector<Candidate> candidates;
  std::vector<PossiblePair> pairs;
  for (std::size_t k = 0; k < out.rays.size(); ++k)
    forPossible(
        robot, eye, out.rays[k], time,
        [&](int s, const Innovation& o, double n)
        {
          const bool inGate = o.d2 <= settings_->gates.inner;
          candidates.push_back({o.d2 + std::log(o.det), static_cast<std::int32_t>(k), s, inGate});
          if (inGate)
            pairs.push_back({static_cast<int>(k), s,
                             rowsOf(robot, belief_->landmark(s), o, out.rays[k], n), o.d2});
        });
  if (settings_->association == Association::kNearest)
    return matchGreedily(candidates, out.matches);
  // The nearest first, so that a search that must end early has tried those.
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const PossiblePair& a, const PossiblePair& b)
                   { return std::tie(a.sighting, a.d2) < std::tie(b.sighting, b.d2); });
  for (const Candidate& c : candidates)
    out.matches[static_cast<std::size_t>(c.sighting)] = kRejected;
  for (const int p : jointlyCompatible(*belief_, pairs, settings_->gateProbability))
  {
    const PossiblePair& pair = pairs[static_cast<std::size_t>(p)];
    out.matches[static_cast<std::size_t>(pair.sighting)] = pair.thing;
  }
}

std::vector<std::int32_t> Map::settle(int robot, const core::LandmarkScan& scan,
                                      const Scan& matched, double time)
{
  std::vector<std::int32_t> out = matched.matches;
  for (std::size_t k = 0; k < out.size(); ++k)
  {
    if (out[k] >= 0)
    {
      Entry& entry = entries_[static_cast<std::size_t>(out[k])];
      ++entry.sightings;
      entry.lastSeen = time;
    }
    else if (out[k] == kNew)
    {
      const bool known = settings_->association == Association::kKnown;
      start(robot, matched.rays[k], known ? scan.sightings[k].id : nextNumber_++, time,
            matched.from, out[k]);
    }
  }
  forgetUnconfirmed(time);
  return out;
}

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
  forPossible(robot, eye, ray, time,
              [&](int s, const Innovation& o, double n)
              {
                const Entry& e = entries_[static_cast<std::size_t>(s)];
                if (e.seen) return;
                const bool doubted = e.existence < kReported;
                const double density = std::exp(-0.5 * o.d2) / (math::kTwoPi * std::sqrt(o.det));
                if (doubted && density <= out.front().density) return;
                const double missed = 1 - e.existence * chanceToSee(robot, eye, s);
                const double weight = e.existence * arrival.detection * density / missed;
                Alternative a{s, std::log(doubted ? weight + fresh : weight), missed, density,
                              rowsOf(robot, belief_->landmark(s), o, ray, n)};
                if (settings_->firstEstimates) deriveAt(e.first, from, a.rows);
                if (doubted)
                  out.front() = a;
                else
                  out.push_back(a);
              });
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

void Map::forget(int slot)
{
  Entry& entry = entries_[static_cast<std::size_t>(slot)];
  belief_->removeLandmark(slot);
  if (settings_->association == Association::kKnown) slotOf_.erase(entry.id);
  entry = {};
}

// Those that are not local wait until they are.
void Map::forgetUnconfirmed(double time)
{
  if (settings_->confirmSightings <= 1 && !settings_->arrival) return;  // all are confirmed
  for (int s = 0; s < static_cast<int>(entries_.size()); ++s)
  {
    const Entry& e = entries_[static_cast<std::size_t>(s)];
    if (e.sightings > 0 && !isConfirmed(e) && time - e.lastSeen > settings_->tentativeTime &&
        belief_->landmark(s) >= 0)
      forget(s);
  }
}

void Map::start(int robot, const Ray& ray, int id, double time, const Point2D& from,
                std::int32_t& slot)
{
  Eye eye = eyeOf(*belief_, robot);
  const Gaussian<Point2D> place = invert(eye, ray);
  if (settings_->firstEstimates)
  {
    eye.x = from.x;
    eye.y = from.y;
  }
  slot = belief_->addLandmark(robot, place, placeByRobot(eye, place.mean));
  const auto s = static_cast<std::size_t>(slot);
  if (s >= entries_.size()) entries_.resize(s + 1);
  entries_[s] = {};
  entries_[s].id = id;
  entries_[s].sightings = 1;
  entries_[s].lastSeen = time;
  entries_[s].first = place.mean;
  if (settings_->association == Association::kKnown) slotOf_[id] = slot;
}
}  // namespace slamot::filters::ekf
