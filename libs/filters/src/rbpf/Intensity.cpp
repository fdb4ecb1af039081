#include "Intensity.h"

#include "sighting/Targets.h"
#include "sighting/inView.h"

#include <algorithm>

namespace slamot::filters::rbpf
{
namespace
{
/// N(point; μ, P) of a component [1/m²].
double densityAt(const maps::Landmark& c, double x, double y)
{
  const double det = c.cxx * c.cyy - c.cxy * c.cxy, dx = x - c.x, dy = y - c.y;
  const double d2 = (c.cyy * dx * dx - 2 * c.cxy * dx * dy + c.cxx * dy * dy) / det;
  return std::exp(-0.5 * d2) / (math::kTwoPi * std::sqrt(det));
}

/// Squared Mahalanobis distance by a component's covariance, grown by a floor.
double distance2(const maps::Landmark& from, const maps::Landmark& c, double floorVar)
{
  const double xx = c.cxx + floorVar, yy = c.cyy + floorVar, det = xx * yy - c.cxy * c.cxy;
  const double dx = from.x - c.x, dy = from.y - c.y;
  return (yy * dx * dx - 2 * c.cxy * dx * dy + xx * dy * dy) / det;
}

/// Weighted components as one with their moments.
class Mixture
{
 public:
  /// \param centre near all of them: moments are summed about it.
  explicit Mixture(const maps::Landmark& centre) : cx_(centre.x), cy_(centre.y) {}
  void add(const maps::Landmark& m, double weight)
  {
    const double dx = m.x - cx_, dy = m.y - cy_;
    w_ += weight;
    x_ += weight * dx;
    y_ += weight * dy;
    xx_ += weight * (m.cxx + dx * dx);
    xy_ += weight * (m.cxy + dx * dy);
    yy_ += weight * (m.cyy + dy * dy);
    sightings_ = std::max<std::uint32_t>(sightings_, m.sightings);
    confirmed_ = confirmed_ || m.confirmed;
  }
  [[nodiscard]] maps::Landmark landmark() const
  {
    const double dx = x_ / w_, dy = y_ / w_;
    maps::Landmark m{cx_ + dx,           cy_ + dy,           xx_ / w_ - dx * dx,
                     xy_ / w_ - dx * dy, yy_ / w_ - dy * dy, sightings_ & 0x7fffffffu,
                     confirmed_};
    m.existence = static_cast<float>(w_);
    return m;
  }

 private:
  double cx_, cy_, w_ = 0, x_ = 0, y_ = 0, xx_ = 0, xy_ = 0, yy_ = 0;
  std::uint32_t sightings_ = 0;
  bool confirmed_ = false;
};

maps::Landmark mergedOf(const maps::Landmark& a, const maps::Landmark& b)
{
  Mixture mixture(a);
  mixture.add(a, a.existence);
  mixture.add(b, b.existence);
  return mixture.landmark();
}
}  // namespace

double Intensity::detectionAt(const Eye& eye, const maps::Landmark& m) const
{
  const ScanSlots& slots = scan_.slots();
  const double var = largestEigenvalue(m.cxx, m.cxy, m.cyy) + slots.rangeVar();
  return settings_.detection * partInView(slots.fov(), eye, m.x, m.y, var, slots.bearingVar());
}

void Intensity::collect(const maps::LandmarkMap& map, const Eye& eye, Scratch& s) const
{
  s.components.clear();
  for (const std::uint32_t slot : scan_.slots().touched())
    if (const maps::Landmark* m = map.find(slot))
      s.components.push_back({*m, detectionAt(eye, *m), slot});
}

void Intensity::pair(const Eye& eye, Scratch& s) const
{
  const ScanSlots& slots = scan_.slots();
  s.pairs.clear();
  s.evidence.assign(slots.size(), settings_.clutterDensity(slots.fov()));
  for (std::size_t j = 0; j < slots.size(); ++j)
    for (const std::uint32_t slot : slots.near(j))
    {
      const auto it =
          std::lower_bound(s.components.begin(), s.components.end(), slot,
                           [](const Component& c, std::uint32_t k) { return c.slot < k; });
      Innovation o;
      if (it == s.components.end() || it->slot != slot || it->detection <= 0 ||
          !scan_.innovateLandmark(eye, j, it->at, nullptr, o, slots.noise(slot)) ||
          o.d2 > settings_.gates.outer)
        continue;
      const double weight = it->detection * it->at.existence * std::exp(logDensity(o, true));
      s.pairs.push_back({static_cast<std::size_t>(it - s.components.begin()), j, o, weight});
      s.evidence[j] += weight;
    }
  for (Pair& p : s.pairs) p.weight /= s.evidence[p.sighting];
}

double Intensity::logWeight(const Eye& eye, const Scratch& s) const
{
  double expected = 0;  // sightings of landmarks
  for (const Component& c : s.components) expected += c.detection * c.at.existence;
  if (settings_.intensity->weight == IntensityWeight::kCluster)
  {
    double sum = -expected;
    for (const double e : s.evidence) sum += std::log(e);
    return sum;
  }
  // Of an empty map: c to the number of sightings, times e to what the map's expected number gains.
  const double logClutter = std::log(settings_.clutterDensity(scan_.slots().fov()));
  double sum = logClutter * static_cast<double>(s.evidence.size()) - expected;
  for (const Pair& p : s.pairs) sum += p.weight;
  if (settings_.intensity->weight == IntensityWeight::kSingleFeature)
    sum += logSingleFeature(eye, s);
  return sum;
}

// Mullane et al. 2011, eq. (40), over that of the empty map: with the feature at the mean of the
// component likeliest to be seen, where prior and posterior intensity both stand for something.
double Intensity::logSingleFeature(const Eye& eye, const Scratch& s) const
{
  const auto best =
      std::max_element(s.components.begin(), s.components.end(),
                       [](const Component& a, const Component& b)
                       { return a.detection * a.at.existence < b.detection * b.at.existence; });
  if (best == s.components.end() || best->detection <= 0) return 0;
  const Point2D exact = best->at.point();
  double seen = 1 - best->detection;
  const double clutter = settings_.clutterDensity(scan_.slots().fov());
  for (std::size_t j = 0; j < s.evidence.size(); ++j)
    if (Innovation o; innovate(eye, scan_.slots().rays()[j], exact.x, exact.y, 0, 0, 0, o))
    {
      soften(scan_.slots().rays()[j], 1, nullptr, o);
      seen += best->detection * std::exp(logDensity(o, true)) / clutter;
    }
  double before = 0, after = 0;
  for (const Component& c : s.components)
  {
    const double d = c.at.existence * densityAt(c.at, exact.x, exact.y);
    before += d;
    after += (1 - c.detection) * d;
  }
  for (const Pair& p : s.pairs)
  {
    maps::Landmark posterior = s.components[p.component].at;
    correct(posterior, p.innovation);
    after += p.weight * densityAt(posterior, exact.x, exact.y);
  }
  return std::log(seen * before / after);
}

void Intensity::split(Scratch& s) const
{
  s.pieces.clear();
  for (const Component& c : s.components)
    if (c.detection > 0)
      s.pieces.push_back({c.at, (1 - c.detection) * c.at.existence, c.slot, kNew, false});
  for (const Pair& p : s.pairs)
  {
    if (p.weight < settings_.intensity->pruneWeight) continue;
    const Component& c = s.components[p.component];
    s.pieces.push_back({c.at, p.weight, c.slot, static_cast<std::int32_t>(p.sighting), false});
    correct(s.pieces.back().at, p.innovation);
  }
}

void Intensity::merge(Scratch& s) const
{
  const IntensitySettings& set = *settings_.intensity;
  std::stable_sort(s.pieces.begin(), s.pieces.end(),
                   [](const Piece& a, const Piece& b) { return a.weight > b.weight; });
  s.merged.clear();
  for (std::size_t i = 0; i < s.pieces.size(); ++i)
  {
    if (s.pieces[i].merged || s.pieces[i].weight < set.pruneWeight) continue;
    Piece out = s.pieces[i];
    Mixture mixture(out.at);
    for (std::size_t k = i; k < s.pieces.size(); ++k)
    {
      Piece& p = s.pieces[k];
      if (p.merged || (k > i && distance2(s.pieces[i].at, p.at, set.floorVar) > set.mergeDistance2))
        continue;
      p.merged = true;
      mixture.add(p.at, p.weight);
    }
    out.at = mixture.landmark();
    out.at.confirmed = out.at.existence >= (out.at.confirmed ? set.unconfirm : set.confirm);
    s.merged.push_back(out);
  }
}

// What explains each sighting: the component with the largest share, unless most is left to
// clutter.
void Intensity::explain(Scratch& s, std::vector<std::int32_t>& matches) const
{
  matches.assign(s.evidence.size(), kRejected);
  s.shares.assign(s.evidence.size(), 0);
  const double clutter = settings_.clutterDensity(scan_.slots().fov());
  for (const Pair& p : s.pairs)
  {
    if (2 * clutter > s.evidence[p.sighting] || p.weight <= s.shares[p.sighting]) continue;
    s.shares[p.sighting] = p.weight;
    matches[p.sighting] = static_cast<std::int32_t>(s.components[p.component].slot);
  }
}

// A component keeps the slot of what it mostly came from.  What split from it takes the slot that
// the sighting has for something new; should that be taken too, it is merged after all.
void Intensity::giveSlots(Scratch& s) const
{
  constexpr std::uint32_t kNone = ~0u;
  const auto holder = [&](std::uint32_t slot, std::size_t before)
  {
    const auto end = s.merged.begin() + static_cast<std::ptrdiff_t>(before);
    return std::find_if(s.merged.begin(), end, [&](const Piece& p) { return p.slot == slot; });
  };
  const auto isFree = [&](std::uint32_t slot, std::size_t before)
  { return holder(slot, before) == s.merged.begin() + static_cast<std::ptrdiff_t>(before); };
  const auto newSlot = [&](std::int32_t sighting)
  { return sighting < 0 ? kNone : scan_.newSlot(static_cast<std::size_t>(sighting)); };
  std::size_t kept = 0;
  for (std::size_t i = 0; i < s.merged.size(); ++i)
  {
    Piece p = s.merged[i];
    if (!isFree(p.slot, kept))
    {
      Piece& first = *holder(p.slot, kept);
      const std::uint32_t own = newSlot(p.sighting), other = newSlot(first.sighting);
      if (own != kNone && isFree(own, kept))
        p.slot = own;
      else if (other != kNone && isFree(other, kept))
        p.slot = other;
      else
      {
        first.at = mergedOf(first.at, p.at);
        continue;
      }
    }
    s.merged[kept++] = p;
  }
  s.merged.resize(kept);
}

void Intensity::store(maps::LandmarkMap& map, const Eye& eye, std::vector<std::int32_t>& matches,
                      Scratch& s, int lane)
{
  ScanSlots& slots = scan_.slots();
  for (const Piece& p : s.merged) map.modify(pool_, lane, p.slot) = p.at;
  const auto isHeld = [&](std::uint32_t slot)
  {
    return std::any_of(s.merged.begin(), s.merged.end(),
                       [&](const Piece& p) { return p.slot == slot; });
  };
  for (const Component& c : s.components)
    if (c.detection > 0 && !isHeld(c.slot)) map.erase(pool_, lane, c.slot);
  for (std::size_t j = 0; j < matches.size(); ++j)
  {
    const std::uint32_t slot = slots.newSlot(j);
    const bool isSplit = isHeld(slot);
    if (matches[j] == kRejected && !isSplit)
    {
      maps::Landmark& m = map.modify(pool_, lane, slot);
      m = scan_.bornFrom(eye, j);
      m.existence = static_cast<float>(settings_.intensity->birthWeight);
      matches[j] = kNew;
    }
    if (isSplit || matches[j] == kNew) slots.noteExtent(lane, slot, *map.find(slot));
  }
  for (const std::uint32_t slot : slots.touched())
    if (const maps::Landmark* m = map.find(slot)) slots.noteExtent(lane, slot, *m);
}

void Intensity::cap(maps::LandmarkMap& map, int lane)
{
  const auto most = static_cast<std::size_t>(settings_.intensity->mostComponents);
  if (map.size() <= most) return;
  std::vector<std::pair<float, std::uint32_t>> byWeight;
  map.visit([&](std::uint32_t slot, const maps::Landmark& m)
            { byWeight.emplace_back(m.existence, slot); });
  // A tenth more than has to go, so that the next scans need not.
  const std::size_t excess = byWeight.size() - most + most / 10;
  std::nth_element(byWeight.begin(), byWeight.begin() + static_cast<std::ptrdiff_t>(excess),
                   byWeight.end());
  for (std::size_t i = 0; i < excess; ++i) map.erase(pool_, lane, byWeight[i].second);
}

double Intensity::update(maps::LandmarkMap& map, const Eye& eye, std::vector<std::int32_t>& matches,
                         Scratch& s, int lane)
{
  collect(map, eye, s);
  pair(eye, s);
  const double weight = logWeight(eye, s);
  split(s);
  merge(s);
  explain(s, matches);
  giveSlots(s);
  store(map, eye, matches, s, lane);
  cap(map, lane);
  return weight;
}
}  // namespace slamot::filters::rbpf
