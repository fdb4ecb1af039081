#include "LandmarkScan.h"

#include <algorithm>

namespace slamot::filters::rbpf
{
namespace
{
constexpr double kLogTwoPi = 1.8378770664093453;
constexpr double kFalseAlarm = 0.05;  // chance that a wrong landmark is "seen" where it should be
constexpr float kMostExistence = 4.0f, kGoneExistence = -2.0f;  // log odds

/// The places that a sighting may be of, over all particles' poses.
maps::Box placesOf(const Ray& ray, const maps::Box& poses, double middle, double halfSpan)
{
  const double a = middle + ray.bearing;
  const double x = ray.range * std::cos(a), y = ray.range * std::sin(a);
  return maps::Box{poses.xMin + x, poses.yMin + y, poses.xMax + x, poses.yMax + y}.grown(
      ray.range * std::min(2.0, halfSpan));
}

void sortUnique(std::vector<std::uint32_t>& v)
{
  std::sort(v.begin(), v.end());
  v.erase(std::unique(v.begin(), v.end()), v.end());
}
}  // namespace

LandmarkScan::LandmarkScan(const Settings& settings, maps::LandmarkPool& pool, int lanes)
    : settings_(settings),
      tracks_(settings.tracking),
      pool_(pool),
      extents_(static_cast<std::size_t>(lanes))
{
  if (settings.detection <= 0) return;
  hitLogOdds_ = std::log(settings.detection / kFalseAlarm);
  missLogOdds_ = std::log((1 - settings.detection) / (1 - kFalseAlarm));
}

void LandmarkScan::begin(const core::LandmarkScan* scan, double time,
                         const std::vector<Pose2D>& priors, const Gaussian<Pose2D>& pending)
{
  rays_.clear();
  logNew_.clear();
  inView_.clear();
  touched_.clear();
  newSlots_.clear();
  if (!scan) return;
  time_ = time;
  fov_ = scan->fov;
  for (const core::Sighting& s : scan->sightings)
  {
    const Ray ray = settings_.ray(s);
    rays_.push_back(ray);
    // By default the density of a pair that the inner gate just lets pass, for a landmark as
    // uncertain as its sighting: then neither calling a thing known nor new pays in itself.
    logNew_.push_back(settings_.newDensity > 0
                          ? std::log(settings_.newDensity)
                          : -0.5 * settings_.gates.inner - kLogTwoPi -
                                0.5 * std::log(4 * ray.varRange * ray.varBearing));
  }
  if (settings_.knownIds)
    findKnown(*scan);
  else
  {
    findCandidates(priors, pending);
    if (settings_.detection > 0) findInView(*scan, priors);
    sortUnique(touched_);
    if (tracks_.isOn()) tracks_.link(rays_, time);
  }
  for (std::size_t j = 0; j < rays_.size(); ++j)
    newSlots_.push_back(settings_.knownIds && knownSlots_[j] >= 0
                            ? static_cast<std::uint32_t>(knownSlots_[j])
                            : index_.reserve());
  setNoise();
  for (auto& lane : extents_)
    if (lane.size() < index_.capacity()) lane.resize(index_.capacity());
  for (auto& lane : extents_)
  {
    for (const std::uint32_t slot : touched_) lane[slot] = {};
    for (const std::uint32_t slot : newSlots_) lane[slot] = {};
  }
}

void LandmarkScan::setNoise()
{
  if (settings_.correlationTime <= 0) return;
  lastSeen_.resize(index_.capacity(), -1e300);
  noise_.resize(index_.capacity());
  for (std::size_t slot = 0; slot < noise_.size(); ++slot)
    noise_[slot] = settings_.noiseAfter(time_ - lastSeen_[slot]);
  for (const std::uint32_t slot : newSlots_)
    if (!settings_.knownIds) lastSeen_[slot] = -1e300;  // the slot's last landmark is another's
}

void LandmarkScan::findKnown(const core::LandmarkScan& scan)
{
  knownSlots_.clear();
  pendingIds_.clear();
  for (const core::Sighting& s : scan.sightings)
  {
    const auto it = slotOfId_.find(s.id);
    const bool repeated =
        std::find(pendingIds_.begin(), pendingIds_.end(), s.id) != pendingIds_.end();
    knownSlots_.push_back(s.id == core::kNoId || repeated ? kRejected
                          : it == slotOfId_.end()         ? kNew
                                                          : static_cast<std::int32_t>(it->second));
    pendingIds_.push_back(s.id);
  }
  idOfSlot_.resize(std::max(idOfSlot_.size(), index_.capacity() + scan.sightings.size()),
                   core::kNoId);
}

void LandmarkScan::findCandidates(const std::vector<Pose2D>& priors,
                                  const Gaussian<Pose2D>& pending)
{
  maps::Box poses;
  double low = 0, high = 0;
  for (const Pose2D& p : priors)
  {
    poses.include(p.x, p.y);
    const double d = math::wrapToPi(p.phi - priors[0].phi);
    low = std::min(low, d);
    high = std::max(high, d);
  }
  const double middle = priors[0].phi + 0.5 * (low + high), halfSpan = 0.5 * (high - low);
  const double sigmas = std::sqrt(settings_.gates.outer);
  const double poseStd = std::sqrt(pending.cov(0, 0) + pending.cov(1, 1));
  near_.resize(std::max(near_.size(), rays_.size()));
  for (std::size_t j = 0; j < rays_.size(); ++j)
  {
    const Ray& ray = rays_[j];
    // The gate's reach: standard deviations of parts add up to more than that of the sum.
    const double reach = sigmas * (std::sqrt(ray.varRange) + poseStd);
    const double across =
        sigmas * (ray.range + reach) * std::sqrt(ray.varBearing + pending.cov(2, 2));
    index_.query(placesOf(ray, poses, middle, halfSpan).grown(reach + across), sigmas, near_[j]);
    touched_.insert(touched_.end(), near_[j].begin(), near_[j].end());
  }
}

void LandmarkScan::findInView(const core::LandmarkScan& scan, const std::vector<Pose2D>& priors)
{
  maps::Box poses;
  for (const Pose2D& p : priors) poses.include(p.x, p.y);
  index_.query(poses.grown(scan.fov.rangeMax), 0, inView_);
  touched_.insert(touched_.end(), inView_.begin(), inView_.end());
}

void LandmarkScan::noteExtent(int lane, std::uint32_t slot, const maps::Landmark& m)
{
  extents_[static_cast<std::size_t>(lane)][slot].include(m.x, m.y,
                                                         largestEigenvalue(m.cxx, m.cxy, m.cyy));
}

void LandmarkScan::match(const maps::LandmarkMap& map, const Eye& eye, const Matrix3& poseCov,
                         std::vector<Candidate>& candidates, std::vector<std::int32_t>& matches)
{
  matches.resize(rays_.size());
  if (settings_.knownIds)
  {
    for (std::size_t j = 0; j < rays_.size(); ++j)
      matches[j] = knownSlots_[j] >= 0 && !map.find(static_cast<std::uint32_t>(knownSlots_[j]))
                       ? kNew
                       : knownSlots_[j];
    return;
  }
  candidates.clear();
  const bool spread = poseCov.trace() > 0;
  for (std::size_t j = 0; j < rays_.size(); ++j)
    for (const std::uint32_t slot : near_[j])
    {
      const maps::Landmark* m = map.find(slot);
      Innovation o;
      // With the sighting's whole noise: which landmark it is of does not get less sure by
      // repetition.
      if (!m || !innovate(eye, rays_[j], m->x, m->y, m->cxx, m->cxy, m->cyy, o)) continue;
      if (spread) o = withPose(o, poseCov);
      if (o.d2 <= settings_.gates.outer)
        candidates.push_back({o.d2 + std::log(o.det), static_cast<std::int32_t>(j),
                              static_cast<std::int32_t>(slot), o.d2 <= settings_.gates.inner});
    }
  matchGreedily(candidates, matches);
}

double LandmarkScan::weigh(const maps::LandmarkMap& map, const Eye& eye, const Matrix3& poseCov,
                           std::vector<std::int32_t>& matches, std::vector<Innovation>& innovations,
                           PoseUpdate* update) const
{
  double sum = 0;
  LogProduct dets;
  innovations.resize(rays_.size());
  for (std::size_t j = 0; j < rays_.size(); ++j)
  {
    Innovation& o = innovations[j];
    const maps::Landmark* m =
        matches[j] < 0 ? nullptr : map.find(static_cast<std::uint32_t>(matches[j]));
    bool paired = m && innovateLandmark(eye, j, static_cast<std::uint32_t>(matches[j]), *m, o);
    if (paired && settings_.knownIds)
      paired = (update ? withPose(o, poseCov).d2 : o.d2) <= settings_.gates.outer;
    if (!paired)
    {
      if (m) matches[j] = kRejected;
      sum += logNew_[j];
      continue;
    }
    sum -= 0.5 * o.d2 + kLogTwoPi;
    dets.times(o.det);
    if (update) update->add(o);
  }
  return sum - 0.5 * dets.log();
}

void LandmarkScan::apply(maps::LandmarkMap& map, const Eye& eye,
                         const std::vector<std::int32_t>& matches,
                         const std::vector<Innovation>* innovations, int lane)
{
  for (const std::uint32_t slot : touched_)
    if (const maps::Landmark* m = map.find(slot)) noteExtent(lane, slot, *m);
  for (std::size_t j = 0; j < rays_.size(); ++j)
  {
    if (matches[j] == kRejected) continue;
    const std::uint32_t slot =
        matches[j] == kNew ? newSlots_[j] : static_cast<std::uint32_t>(matches[j]);
    maps::Landmark& m = map.modify(pool_, lane, slot);
    if (matches[j] == kNew)
    {
      const Gaussian<Point2D> place = invert(eye, rays_[j]);
      m = {place.mean.x, place.mean.y, place.cov(0, 0), place.cov(0, 1), place.cov(1, 1), 1, 0};
    }
    else if (innovations)
      correct(m, (*innovations)[j]);
    else if (Innovation o; innovateLandmark(eye, j, slot, m, o))
      correct(m, o);
    m.existence = std::min(kMostExistence, m.existence + static_cast<float>(hitLogOdds_));
    if (!settings_.knownIds) noteExtent(lane, slot, m);
  }
  if (!inView_.empty()) applyMisses(map, eye, matches, lane);
}

void LandmarkScan::applyMisses(maps::LandmarkMap& map, const Eye& eye,
                               const std::vector<std::int32_t>& matches, int lane)
{
  for (const std::uint32_t slot : inView_)
  {
    const maps::Landmark* m = map.find(slot);
    if (!m ||
        std::find(matches.begin(), matches.end(), static_cast<std::int32_t>(slot)) != matches.end())
      continue;
    const double dx = m->x - eye.x, dy = m->y - eye.y, r = std::hypot(dx, dy);
    const double bearing = math::wrapToPi(std::atan2(dy, dx) - eye.phi);
    // Only what is clearly in view counts as missed: three deviations inside the limits.
    const double margin = 3 * std::sqrt(largestEigenvalue(m->cxx, m->cxy, m->cyy));
    const double turn = margin / std::max(r, 0.1);
    const bool allRound = fov_.bearingMax - fov_.bearingMin > math::kTwoPi - 1e-6;
    if (r < fov_.rangeMin + margin || r > fov_.rangeMax - margin) continue;
    if (!allRound && (bearing < fov_.bearingMin + turn || bearing > fov_.bearingMax - turn))
      continue;
    const float odds = m->existence + static_cast<float>(missLogOdds_);
    if (odds < kGoneExistence)
      map.erase(pool_, lane, slot);
    else
      map.modify(pool_, lane, slot).existence = odds;
  }
}

void LandmarkScan::finish(const std::vector<const std::vector<std::int32_t>*>& matches)
{
  if (settings_.correlationTime > 0)
    for (const auto* m : matches)
      for (std::size_t j = 0; j < rays_.size(); ++j)
        if ((*m)[j] != kRejected)
          lastSeen_[(*m)[j] == kNew ? newSlots_[j] : static_cast<std::size_t>((*m)[j])] = time_;
  for (std::size_t j = rays_.size(); j-- > 0;)  // backwards, so that unused numbers are given back
  {
    if (settings_.knownIds && knownSlots_[j] >= 0) continue;
    const bool used =
        std::any_of(matches.begin(), matches.end(), [&](const auto* m) { return (*m)[j] == kNew; });
    if (!used)
      index_.release(newSlots_[j]);
    else if (settings_.knownIds)
    {
      slotOfId_[pendingIds_[j]] = newSlots_[j];
      idOfSlot_[newSlots_[j]] = pendingIds_[j];
    }
    else
      touched_.push_back(newSlots_[j]);
  }
  for (const std::uint32_t slot : touched_)
  {
    maps::SlotExtent extent;
    for (const auto& lane : extents_)
      if (!lane[slot].means.empty())
      {
        extent.means.include(lane[slot].means);
        extent.largestVar = std::max(extent.largestVar, lane[slot].largestVar);
      }
    if (extent.means.empty())
      index_.release(slot);  // no particle holds it any more
    else
      index_.place(slot, extent);
  }
}

void LandmarkScan::releaseUnoccupied(const std::vector<bool>& occupied)
{
  if (!settings_.knownIds) index_.releaseUnoccupied(occupied);
}

int LandmarkScan::idOf(std::uint32_t slot) const
{
  return settings_.knownIds ? idOfSlot_[slot] : static_cast<int>(index_.serial(slot));
}
}  // namespace slamot::filters::rbpf
