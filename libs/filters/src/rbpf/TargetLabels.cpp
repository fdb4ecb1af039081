#include "TargetLabels.h"

#include <algorithm>
#include <tuple>

namespace slamot::filters::rbpf
{
namespace
{
constexpr int kBlobBits = 24;  // of a label: the blob, below the scan

bool isBefore(const core::Blob& a, const core::Blob& b)
{
  return std::tie(a.bearing, a.range, a.label, a.id) < std::tie(b.bearing, b.range, b.label, b.id);
}
}  // namespace

bool areOne(const core::TargetEstimate& older, const core::TargetEstimate& younger,
            const TargetSetSettings& set)
{
  if (older.identified || younger.identified || older.label != younger.label) return false;
  const Matrix2 floor = set.floorVar * Matrix2::Identity();
  const Matrix2 place = younger.pose.cov.topLeftCorner<2, 2>() + floor;
  const Matrix2 velocity = younger.velocityCov + floor;
  const Vector2 d(older.pose.mean.x - younger.pose.mean.x, older.pose.mean.y - younger.pose.mean.y);
  const Vector2 v = older.velocity - younger.velocity;
  return d.dot(place.inverse() * d) + v.dot(velocity.inverse() * v) <= set.mergeDistance2;
}

std::size_t TargetLabels::find(std::uint64_t key) const
{
  const auto it = std::lower_bound(keys_.begin(), keys_.end(), key);
  return it == keys_.end() || *it != key ? kNone : static_cast<std::size_t>(it - keys_.begin());
}

void TargetLabels::addStart(int id, double time)
{
  Track track;
  track.id = id;
  track.identified = track.confirmed = true;
  track.lastSeen = time;
  keys_.push_back(keys_.size());
  tracks_.push_back(track);
  usedIds_.push_back(id);
}

std::vector<std::uint64_t> TargetLabels::birthKeys(const std::vector<core::Blob>& blobs,
                                                   std::uint64_t scan) const
{
  std::vector<std::uint64_t> out;
  for (std::size_t k = 0; k < blobs.size(); ++k)
  {
    const core::Blob& blob = blobs[k];
    std::uint64_t rank = 0;
    for (std::size_t other = 0; other < blobs.size(); ++other)
      if (isBefore(blobs[other], blob) || (!isBefore(blob, blobs[other]) && other < k)) ++rank;
    out.push_back((scan << kBlobBits) + rank);
    const auto known = [&](const Track& t) { return t.identified && Tracks::fits(t, blob); };
    const auto it = std::find_if(tracks_.begin(), tracks_.end(), known);
    if (blob.id != core::kNoId && it != tracks_.end())
      out.back() = keys_[static_cast<std::size_t>(it - tracks_.begin())];
  }
  return out;
}

void TargetLabels::add(std::uint64_t key, const core::Blob& blob, double time)
{
  const auto at = std::lower_bound(keys_.begin(), keys_.end(), key);
  if (at != keys_.end() && *at == key) return;
  Track track;
  track.label = blob.label;
  track.id = blob.id;
  track.identified = blob.id != core::kNoId;
  track.lastSeen = time;
  if (track.identified) usedIds_.push_back(blob.id);
  tracks_.insert(tracks_.begin() + (at - keys_.begin()), track);
  keys_.insert(at, key);
}

void TargetLabels::hit(std::size_t index, const core::Blob& blob, double time)
{
  Track& track = tracks_[index];
  track.lastSeen = time;
  if (track.label.empty()) track.label = blob.label;
}

void TargetLabels::settle(std::size_t index, double existence)
{
  Track& track = tracks_[index];
  track.confirmed = existence >= (track.confirmed ? set_.unconfirm : set_.confirm);
  if (!track.confirmed || track.id != core::kNoId) return;
  while (std::count(usedIds_.begin(), usedIds_.end(), nextNumber_) > 0) ++nextNumber_;
  track.id = nextNumber_++;
}

bool TargetLabels::isLost(std::size_t index, double time, double std) const
{
  const Track& track = tracks_[index];
  const double unseen = time - track.lastSeen;
  if (!track.confirmed) return unseen > rules_.tentativeTime;
  return unseen > rules_.lostTime || !(std <= rules_.lostStd);
}

void TargetLabels::erase(std::size_t index)
{
  keys_.erase(keys_.begin() + static_cast<std::ptrdiff_t>(index));
  tracks_.erase(tracks_.begin() + static_cast<std::ptrdiff_t>(index));
}
}  // namespace slamot::filters::rbpf
