#include "claims.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace slamot::moving
{
namespace
{
using perception::Cluster;
using Owners = std::vector<const MovingTrack*>;  // by point of a cluster

double gateOf(const MovingTrack& t)
{
  constexpr double kLeast = 0.1, kMost = 0.35;  // [m]
  return std::clamp(3 * t.deviation(), kLeast, kMost);
}

/// Whether what lies in a moving thing's gate stood there before.
bool standsThere(const Cluster& c, const Owners& owners, const Look& look, const FreeSpace& space)
{
  constexpr double kMostly = 0.7;
  int owned = 0, standing = 0;
  for (std::size_t i = 0; i < owners.size(); ++i)
  {
    if (!owners[i]) continue;
    ++owned;
    standing += space.isOccupied(look.at(c.points[i]), look.time) ? 1 : 0;
  }
  return standing > kMostly * owned;
}

/// A thing's points beside those that are in the gate are its own too.
void spread(Owners& owners)
{
  for (std::size_t i = 1; i < owners.size(); ++i)
    if (!owners[i]) owners[i] = owners[i - 1];
  for (std::size_t i = owners.size() - 1; i-- > 0;)
    if (!owners[i]) owners[i] = owners[i + 1];
}

using Parts = std::map<const MovingTrack*, std::vector<Thing>>;

void addRuns(const Cluster& c, const Owners& owners, const Look& look, const FreeSpace& space,
             Parts& parts)
{
  for (std::size_t from = 0; from < owners.size();)
  {
    std::size_t to = from;
    while (to < owners.size() && owners[to] == owners[from]) ++to;
    if (owners[from]) parts[owners[from]].push_back(thingOf(c, from, to, look, space));
    from = to;
  }
}

/// Of the parts in a box's gate, those that lie on it once it is fitted to them all: what stands
/// beside it is no part of it.
Thing ownParts(const MovingTrack& t, const std::vector<Thing>& parts, const Look& look,
               const MovingOptions& options)
{
  constexpr double kOff = 0.1;  // [m], mean distance
  Thing all, own;
  for (const Thing& part : parts) join(all, part, look);
  const BoxState box = t.fitted(all, look, options);
  for (const Thing& part : parts)
  {
    double sum = 0;
    for (const Point2D& p : part.points) sum += distanceToOutline(box, p);
    if (sum <= kOff * static_cast<double>(part.points.size())) join(own, part, look);
  }
  return own;
}
}  // namespace

const MovingTrack* ownerOf(const Point2D& at, const std::vector<MovingTrack>& tracks)
{
  const MovingTrack* owner = nullptr;
  double nearest = std::numeric_limits<double>::infinity();
  for (const MovingTrack& t : tracks)
  {
    if (!t.box()) continue;
    const double d = distanceToOutline(*t.box(), at);
    if (d <= gateOf(t) && d < nearest) nearest = d, owner = &t;
  }
  return owner;
}

Claims claim(const std::vector<Cluster>& clusters, const std::vector<MovingTrack>& tracks,
             const Look& look, const FreeSpace& space, const MovingOptions& options)
{
  Claims out;
  Parts parts;
  for (const Cluster& c : clusters)
  {
    Owners owners;
    for (const auto& p : c.points) owners.push_back(ownerOf(look.at(p), tracks));
    const auto owned = std::count_if(owners.begin(), owners.end(), [](auto* t) { return t; });
    const bool isSmall = c.width() <= options.maxSize;
    if (owned == 0)
    {
      if (isSmall && static_cast<int>(c.points.size()) >= options.minPoints)
        out.rest.push_back(thingOf(c, 0, c.points.size(), look, space));
      continue;
    }
    if (standsThere(c, owners, look, space)) continue;
    if (isSmall && 2 * owned >= static_cast<std::ptrdiff_t>(owners.size())) spread(owners);
    addRuns(c, owners, look, space, parts);
  }
  for (const auto& [track, its] : parts)
    if (Thing own = ownParts(*track, its, look, options); !own.points.empty())
      out.boxes.emplace(track, std::move(own));
  return out;
}

std::vector<PointPair> pairPoints(const std::vector<MovingTrack>& tracks,
                                  const std::vector<Thing>& things)
{
  constexpr double kGate = 0.3;  // [m]
  std::vector<std::tuple<double, std::size_t, std::size_t>> near;
  for (std::size_t t = 0; t < tracks.size(); ++t)
  {
    if (tracks[t].box()) continue;
    const Point2D at = tracks[t].place();
    for (std::size_t i = 0; i < things.size(); ++i)
    {
      const double apart = std::hypot(at.x - things[i].centre.x, at.y - things[i].centre.y);
      if (apart < kGate + tracks[t].deviation()) near.emplace_back(apart, t, i);
    }
  }
  std::sort(near.begin(), near.end());
  std::vector<bool> trackUsed(tracks.size(), false), thingUsed(things.size(), false);
  std::vector<PointPair> out;
  for (const auto& [apart, t, i] : near)
  {
    if (trackUsed[t] || thingUsed[i]) continue;
    trackUsed[t] = thingUsed[i] = true;
    out.push_back({t, i});
  }
  return out;
}
}  // namespace slamot::moving
