#include "Map.h"

#include "JointCompatibility.h"
#include "relate.h"

#include <set>
#include <tuple>

namespace slamot::filters::ekf
{
namespace
{
constexpr int kMostRejections = 3;  // in a row, and no fewer than the sightings before
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
  return std::sqrt(2 * settings_->gates.outer * settings_->reach * most);
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

// The tails of a law reach far: in a gate of theirs nothing new would ever be seen.  What is less
// likely than a pair at the gate's edge is without a law, and out of an ordinary error's gate, is
// no pair. Hypotheses weigh what is new themselves.
bool Map::isRatherNew(int robot, int object, const Eye& eye, const Ray& ray,
                      const Innovation& o) const
{
  if (!ray.law || settings_->arrival) return false;
  const double edge = settings_->gates.inner + std::log(4 * ray.varRange * ray.varBearing);
  Ray ordinary = ray;
  ordinary.law = nullptr;
  Innovation of;
  return o.d2 + std::log(o.det) > edge &&
         (!relate(*belief_, robot, object, eye, ordinary, of) || of.d2 > settings_->gates.outer);
}

std::vector<Map::Possible> Map::possible(int robot, const Eye& eye, const Ray& ray,
                                         double time) const
{
  std::vector<Possible> out;
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
    if (dx * dx + dy * dy <= 2 * settings_->gates.outer * ray.reach * most &&
        relate(*belief_, robot, j, eye, ray, o, n) && o.d2 <= settings_->gates.outer &&
        !isRatherNew(robot, j, eye, ray, o))
      out.push_back({s, o, n});
  }
  return out;
}

void Map::matchByPlace(int robot, double time, Scan& out)
{
  const Eye eye = eyeOf(*belief_, robot);
  std::vector<Candidate> candidates;
  std::vector<PossiblePair> pairs;
  for (std::size_t k = 0; k < out.rays.size(); ++k)
    for (const auto& [slot, o, n] : possible(robot, eye, out.rays[k], time))
    {
      const bool inGate = o.d2 <= settings_->gates.inner;
      candidates.push_back({o.d2 + std::log(o.det), static_cast<std::int32_t>(k), slot, inGate});
      if (inGate)
        pairs.push_back({static_cast<int>(k), slot,
                         rowsOf(robot, belief_->landmark(slot), o, out.rays[k], n), o.d2});
    }
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
