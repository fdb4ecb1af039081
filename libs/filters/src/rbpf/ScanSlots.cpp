#include "ScanSlots.h"

#include <algorithm>

namespace slamot::filters::rbpf
{
namespace
{
/// Where the particles are, and how their headings differ.
struct Spread
{
  maps::Box places;
  double middle = 0, halfSpan = 0;  // of the headings

  explicit Spread(const std::vector<Pose2D>& poses)
  {
    double low = 0, high = 0;
    for (const Pose2D& p : poses)
    {
      places.include(p.x, p.y);
      const double d = math::wrapToPi(p.phi - poses[0].phi);
      low = std::min(low, d);
      high = std::max(high, d);
    }
    middle = poses[0].phi + 0.5 * (low + high);
    halfSpan = 0.5 * (high - low);
  }

  /// The places that a sighting may be of.
  [[nodiscard]] maps::Box of(const Ray& ray) const
  {
    const double a = middle + ray.bearing;
    return seen({ray.range * std::cos(a), ray.range * std::sin(a)})
        .grown(ray.range * std::min(2.0, halfSpan));
  }
  /// The places that may be in view.
  [[nodiscard]] maps::Box of(const core::FieldOfView& fov) const
  {
    const double from = middle - halfSpan + fov.bearingMin, to = middle + halfSpan + fov.bearingMax;
    maps::Box out = places;
    const auto reach = [&](double a) {
      out.include(seen({fov.rangeMax * std::cos(a), fov.rangeMax * std::sin(a)}));
    };
    reach(from);
    reach(to);
    constexpr double kQuarter = math::kPi / 2;  // an arc is widest along the axes
    for (double a = std::ceil(from / kQuarter) * kQuarter; a < std::min(to, from + math::kTwoPi);
         a += kQuarter)
      reach(a);
    return out;
  }

 private:
  [[nodiscard]] maps::Box seen(const Point2D& p) const
  {
    return {places.xMin + p.x, places.yMin + p.y, places.xMax + p.x, places.yMax + p.y};
  }
};

void sortUnique(std::vector<std::uint32_t>& v)
{
  std::sort(v.begin(), v.end());
  v.erase(std::unique(v.begin(), v.end()), v.end());
}
}  // namespace

ScanSlots::ScanSlots(const Settings& settings, int lanes)
    : settings_(settings), extents_(static_cast<std::size_t>(lanes))
{
}

void ScanSlots::begin(const core::LandmarkScan* scan, double time,
                      const std::vector<Pose2D>& priors, const Gaussian<Pose2D>& pending)
{
  rays_.clear();
  inView_.clear();
  touched_.clear();
  newSlots_.clear();
  if (!scan) return;
  time_ = time;
  fov_ = scan->fov;
  for (const core::Sighting& s : scan->sightings) rays_.push_back(settings_.ray(s));
  if (!rays_.empty())
  {
    rangeVar_ = rays_.back().varRange;
    bearingVar_ = rays_.back().varBearing;
  }
  if (settings_.isKnown())
    findKnown(*scan);
  else
  {
    findCandidates(priors, pending);
    if (settings_.detection > 0) findInView(*scan, priors);
    sortUnique(touched_);
  }
  for (std::size_t j = 0; j < rays_.size(); ++j)
    newSlots_.push_back(settings_.isKnown() && known_[j] >= 0
                            ? static_cast<std::uint32_t>(known_[j])
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

void ScanSlots::setNoise()
{
  if (settings_.correlationTime <= 0) return;
  lastSeen_.resize(index_.capacity(), -1e300);
  noise_.resize(index_.capacity());
  for (std::size_t slot = 0; slot < noise_.size(); ++slot)
    noise_[slot] = settings_.noiseAfter(time_ - lastSeen_[slot]);
  for (const std::uint32_t slot : newSlots_)
    if (!settings_.isKnown()) lastSeen_[slot] = -1e300;  // the slot's last landmark is another's
}

void ScanSlots::findKnown(const core::LandmarkScan& scan)
{
  known_.clear();
  pendingIds_.clear();
  for (const core::Sighting& s : scan.sightings)
  {
    const auto it = slotOfId_.find(s.id);
    const bool repeated =
        std::find(pendingIds_.begin(), pendingIds_.end(), s.id) != pendingIds_.end();
    known_.push_back(s.id == core::kNoId || repeated ? kRejected
                     : it == slotOfId_.end()         ? kNew
                                                     : static_cast<std::int32_t>(it->second));
    pendingIds_.push_back(s.id);
  }
  idOfSlot_.resize(std::max(idOfSlot_.size(), index_.capacity() + scan.sightings.size()),
                   core::kNoId);
}

void ScanSlots::findCandidates(const std::vector<Pose2D>& priors, const Gaussian<Pose2D>& pending)
{
  const Spread spread(priors);
  const double poseStd = std::sqrt(pending.cov(0, 0) + pending.cov(1, 1));
  near_.resize(std::max(near_.size(), rays_.size()));
  for (std::size_t j = 0; j < rays_.size(); ++j)
  {
    const Ray& ray = rays_[j];
    const double sigmas = std::sqrt(settings_.gates.outer * ray.reach);
    // The gate's reach: standard deviations of parts add up to more than that of the sum.
    const double reach = sigmas * (std::sqrt(ray.varRange) + poseStd);
    const double across =
        sigmas * (ray.range + reach) * std::sqrt(ray.varBearing + pending.cov(2, 2));
    index_.query(spread.of(ray).grown(reach + across), sigmas, near_[j]);
    touched_.insert(touched_.end(), near_[j].begin(), near_[j].end());
  }
}

void ScanSlots::findInView(const core::LandmarkScan& scan, const std::vector<Pose2D>& priors)
{
  constexpr double kSigmas = 3;  // by which a landmark may be in view whose mean is not
  index_.query(Spread(priors).of(scan.fov), kSigmas, inView_);
  touched_.insert(touched_.end(), inView_.begin(), inView_.end());
}

// Over all lanes.
maps::SlotExtent ScanSlots::extentOf(std::uint32_t slot) const
{
  maps::SlotExtent out;
  for (const auto& lane : extents_)
    if (!lane[slot].means.empty())
    {
      out.means.include(lane[slot].means);
      out.largestVar = std::max(out.largestVar, lane[slot].largestVar);
    }
  return out;
}

void ScanSlots::finish(const std::vector<const std::vector<std::int32_t>*>& matches)
{
  if (settings_.correlationTime > 0)
    for (const auto* m : matches)
      for (std::size_t j = 0; j < rays_.size(); ++j)
        if ((*m)[j] != kRejected)
          lastSeen_[(*m)[j] == kNew ? newSlots_[j] : static_cast<std::size_t>((*m)[j])] = time_;
  for (std::size_t j = rays_.size(); j-- > 0;)  // backwards, so that unused numbers are given back
  {
    if (settings_.isKnown() && known_[j] >= 0) continue;
    const bool used =
        !extentOf(newSlots_[j]).means.empty() ||
        std::any_of(matches.begin(), matches.end(), [&](const auto* m) { return (*m)[j] == kNew; });
    if (!used)
      index_.release(newSlots_[j]);
    else if (settings_.isKnown())
    {
      slotOfId_[pendingIds_[j]] = newSlots_[j];
      idOfSlot_[newSlots_[j]] = pendingIds_[j];
    }
    else
      touched_.push_back(newSlots_[j]);
  }
  for (const std::uint32_t slot : touched_)
  {
    const maps::SlotExtent extent = extentOf(slot);
    if (extent.means.empty())
      index_.release(slot);  // no particle holds it any more
    else
      index_.place(slot, extent);
  }
}

void ScanSlots::releaseUnoccupied(const std::vector<bool>& occupied)
{
  if (!settings_.isKnown()) index_.releaseUnoccupied(occupied);
}

int ScanSlots::idOf(std::uint32_t slot) const
{
  return settings_.isKnown() ? idOfSlot_[slot] : static_cast<int>(index_.serial(slot));
}
}  // namespace slamot::filters::rbpf
