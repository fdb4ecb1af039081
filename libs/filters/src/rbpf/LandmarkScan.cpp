#include "LandmarkScan.h"

#include "sighting/Targets.h"

#include <algorithm>

namespace slamot::filters::rbpf
{
namespace
{
constexpr double kLogTwoPi = 1.8378770664093453;
constexpr double kFalseAlarm = 0.05;  // chance that a wrong landmark is "seen" where it should be
constexpr float kMostExistence = 4.0f, kGoneExistence = -2.0f;  // log odds
}  // namespace

LandmarkScan::LandmarkScan(const Settings& settings, maps::LandmarkPool& pool, int lanes)
    : settings_(settings),
      slots_(settings, lanes),
      tracks_(settings.tracking),
      joint_(settings),
      pool_(pool)
{
  if (settings.detection <= 0) return;
  hitLogOdds_ = std::log(settings.detection / kFalseAlarm);
  missLogOdds_ = std::log((1 - settings.detection) / (1 - kFalseAlarm));
}

void LandmarkScan::begin(const core::LandmarkScan* scan, double time,
                         const std::vector<Pose2D>& priors, const Gaussian<Pose2D>& pending)
{
  slots_.begin(scan, time, priors, pending);
  logNew_.clear();
  if (!scan) return;
  // By default the density of a pair that the inner gate just lets pass, for a landmark as
  // uncertain as its sighting: then neither calling a thing known nor new pays in itself.
  for (const Ray& ray : slots_.rays())
    logNew_.push_back(settings_.newDensity > 0
                          ? std::log(settings_.newDensity)
                          : -0.5 * settings_.gates.inner - kLogTwoPi -
                                0.5 * std::log(4 * ray.varRange * ray.varBearing));
  if (settings_.clutter > 0) logClutter_ = std::log(settings_.clutterDensity(scan->fov));
  if (tracks_.isOn()) tracks_.link(slots_.rays(), time);
  if (settings_.isJoint()) joint_.reserve(slots_.size());
}

/// f(sighting, slot, innovation without the pose's part, the same with it) for what passes the
/// outer gate.
template <class F>
void LandmarkScan::forPossiblePairs(const maps::LandmarkMap& map, const Eye& eye,
                                    const Matrix3& root, F&& f) const
{
  const Matrix3 poseCov = root * root.transpose();
  const bool spread = settings_.isInformed() && poseCov.trace() > 0;
  for (std::size_t j = 0; j < slots_.size(); ++j)
    for (const std::uint32_t slot : slots_.near(j))
    {
      const maps::Landmark* m = map.find(slot);
      if (!m || isBeyond(settings_.gates.outer, eye, slots_.rays()[j], m->x, m->y, m->cxx, m->cyy,
                         spread ? &poseCov : nullptr))
        continue;
      Innovation o;
      // With the sighting's whole noise: which landmark it is of does not get less sure by
      // repetition.
      if (!mayBeOf(*m) || !innovateLandmark(eye, j, *m, spread ? &poseCov : nullptr, o, 1))
        continue;
      const Innovation whole = spread ? withPose(o, poseCov) : o;
      if (whole.d2 <= settings_.gates.outer && !isRatherNew(j, eye, *m, spread, poseCov, whole))
        f(static_cast<std::int32_t>(j), static_cast<std::int32_t>(slot), o, whole);
    }
}

// The tails of a law reach far: in a gate of theirs nothing new would ever be seen.  What is
// likelier of something new, and out of the gate of an ordinary error, is no pair.
bool LandmarkScan::isRatherNew(std::size_t j, const Eye& eye, const maps::Landmark& m, bool spread,
                               const Matrix3& poseCov, const Innovation& whole) const
{
  const Ray& ray = slots_.rays()[j];
  Innovation o;
  if (!ray.law || logDensity(whole, true) >= logNew_[j] ||
      !innovate(eye, ray, m.x, m.y, m.cxx, m.cxy, m.cyy, o))
    return false;
  return (spread ? withPose(o, poseCov) : o).d2 > settings_.gates.outer;
}

void LandmarkScan::match(const maps::LandmarkMap& map, const Eye& eye, const Matrix3& root,
                         MatchScratch& scratch, std::vector<std::int32_t>& matches) const
{
  matches.resize(slots_.size());
  if (settings_.isKnown())
  {
    for (std::size_t j = 0; j < slots_.size(); ++j)
    {
      const std::int32_t known = slots_.known()[j];
      matches[j] = known >= 0 && !map.find(static_cast<std::uint32_t>(known)) ? kNew : known;
    }
    return;
  }
  if (settings_.association == Association::kNearest)
  {
    scratch.candidates.clear();
    forPossiblePairs(map, eye, root,
                     [&](std::int32_t j, std::int32_t slot, const Innovation&, const Innovation& o)
                     {
                       scratch.candidates.push_back(
                           {o.d2 + std::log(o.det), j, slot, o.d2 <= settings_.gates.inner});
                     });
    matchGreedily(scratch.candidates, matches);
    return;
  }
  scratch.joint.pairs.clear();
  forPossiblePairs(
      map, eye, root,
      [&](std::int32_t j, std::int32_t slot, const Innovation& o, const Innovation& whole) {
        scratch.joint.pairs.push_back({j, slot, o, whole.d2});
      });
  joint_.match(settings_.isInformed() ? root : Matrix3::Zero(), logNew_, scratch.joint, matches);
}

PoseUpdate LandmarkScan::gather(const maps::LandmarkMap& map, const Eye& eye, const Matrix3& root,
                                std::vector<std::int32_t>& matches) const
{
  PoseUpdate update;
  Matrix3 poseCov = root * root.transpose();
  Eye from = eye;
  Vector3 shift = Vector3::Zero();
  for (std::size_t j = 0; j < matches.size(); ++j)
  {
    if (matches[j] < 0) continue;
    const auto slot = static_cast<std::uint32_t>(matches[j]);
    const maps::Landmark* m = map.find(slot);
    Innovation o;
    if (!m || !innovateLandmark(from, j, *m, &poseCov, o, slots_.noise(slot))) continue;
    if (settings_.isKnown() && withPose(o, poseCov).d2 > settings_.gates.outer)
    {
      matches[j] = kRejected;
      continue;
    }
    update.add(shifted(o, -shift));
    if (!settings_.sequential) continue;
    const PoseUpdate::Result pose = update.solve(root);
    shift = pose.shift;
    poseCov = pose.root * pose.root.transpose();
    from = Eye({eye.x + shift[0], eye.y + shift[1], eye.phi + shift[2]});
  }
  return update;
}

double LandmarkScan::weigh(const maps::LandmarkMap& map, const Eye& eye, const Matrix3& poseCov,
                           std::vector<std::int32_t>& matches, std::vector<Innovation>& innovations,
                           PoseUpdate* update) const
{
  double sum = 0;
  LogProduct dets;
  innovations.resize(slots_.size());
  for (std::size_t j = 0; j < slots_.size(); ++j)
  {
    Innovation& o = innovations[j];
    const maps::Landmark* m =
        matches[j] < 0 ? nullptr : map.find(static_cast<std::uint32_t>(matches[j]));
    bool paired = m && innovateLandmark(eye, j, *m, update ? &poseCov : nullptr, o,
                                        slots_.noise(static_cast<std::uint32_t>(matches[j])));
    if (paired && settings_.isKnown())
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
  for (const std::uint32_t slot : slots_.touched())
    if (const maps::Landmark* m = map.find(slot)) slots_.noteExtent(lane, slot, *m);
  for (std::size_t j = 0; j < slots_.size(); ++j)
  {
    if (matches[j] == kRejected) continue;
    const std::uint32_t slot =
        matches[j] == kNew ? slots_.newSlot(j) : static_cast<std::uint32_t>(matches[j]);
    maps::Landmark& m = map.modify(pool_, lane, slot);
    if (matches[j] == kNew) m = bornFrom(eye, j);
    Innovation o;
    const bool seen = matches[j] != kNew &&
                      (innovations || innovateLandmark(eye, j, m, nullptr, o, slots_.noise(slot)));
    if (seen && innovations) o = (*innovations)[j];
    if (seen) correct(m, o);
    m.existence = std::min(kMostExistence, m.existence + hitLogOdds(seen ? &o : nullptr));
    if (!settings_.isKnown()) slots_.noteExtent(lane, slot, m);
  }
  if (!slots_.inView().empty()) applyMisses(map, eye, matches, lane);
}

maps::Landmark LandmarkScan::bornFrom(const Eye& eye, std::size_t j) const
{
  const Ray& ray = slots_.rays()[j];
  const auto place = settings_.unscentedMap ? invertUnscented(eye, ray) : invert(eye, ray);
  return {place.mean.x, place.mean.y, place.cov(0, 0), place.cov(0, 1), place.cov(1, 1), 1, 0};
}

// Where the clutter's density is known, by how much likelier the sighting is of the landmark; a new
// one may be either.
float LandmarkScan::hitLogOdds(const Innovation* o) const
{
  if (!(settings_.clutter > 0) || settings_.detection <= 0) return static_cast<float>(hitLogOdds_);
  if (!o) return 0;
  const double ratio = std::log(settings_.detection) + logDensity(*o, true) - logClutter_;
  return static_cast<float>(std::clamp(ratio, -1.0, 4.0));
}

void LandmarkScan::applyMisses(maps::LandmarkMap& map, const Eye& eye,
                               const std::vector<std::int32_t>& matches, int lane)
{
  const core::FieldOfView& fov = slots_.fov();
  for (const std::uint32_t slot : slots_.inView())
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
    const bool allRound = fov.bearingMax - fov.bearingMin > math::kTwoPi - 1e-6;
    if (r < fov.rangeMin + margin || r > fov.rangeMax - margin) continue;
    if (!allRound && (bearing < fov.bearingMin + turn || bearing > fov.bearingMax - turn)) continue;
    const float odds = m->existence + static_cast<float>(missLogOdds_);
    if (odds < kGoneExistence)
      map.erase(pool_, lane, slot);
    else
      map.modify(pool_, lane, slot).existence = odds;
  }
}

}  // namespace slamot::filters::rbpf
