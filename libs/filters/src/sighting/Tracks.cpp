#include "Tracks.h"

#include <algorithm>

namespace slamot::filters
{
TrackRules TrackRules::from(core::Params& p)
{
  return {p.integer("target_confirm_sightings", 1, 1000, 3), p.positive("target_tentative_s", 1.0),
          p.positive("target_lost_s", 30.0), p.positive("target_lost_std_m", 5.0)};
}

bool Tracks::fits(const Track& track, const core::Blob& blob)
{
  if (!track.label.empty() && track.label != blob.label) return false;
  return blob.id == core::kNoId || (track.identified && track.id == blob.id);
}

void Tracks::addStart(int id, double time)
{
  Track track;
  track.id = id;
  track.identified = track.confirmed = true;
  track.lastSeen = time;
  tracks_.push_back(track);
  usedIds_.push_back(id);
}

void Tracks::add(const core::Blob& blob, double time)
{
  Track track;
  track.label = blob.label;
  track.identified = blob.id != core::kNoId;
  track.id = blob.id;
  if (track.identified) usedIds_.push_back(blob.id);
  tracks_.push_back(track);
  hit(tracks_.size() - 1, blob, time);
}

void Tracks::hit(std::size_t index, const core::Blob& blob, double time)
{
  Track& track = tracks_[index];
  track.lastSeen = time;
  track.rejections = 0;
  if (track.label.empty()) track.label = blob.label;
  ++track.hits;
  if (!track.confirmed && (track.identified || track.hits >= rules_.confirmSightings))
    confirm(track);
}

void Tracks::confirm(Track& track)
{
  track.confirmed = true;
  if (track.identified) return;
  while (std::count(usedIds_.begin(), usedIds_.end(), nextNumber_) > 0) ++nextNumber_;
  track.id = nextNumber_++;
}

void Tracks::reject(const core::Blob& blob)
{
  if (blob.id == core::kNoId) return;
  for (Track& t : tracks_)
    if (fits(t, blob)) ++t.rejections;
}

bool Tracks::isLost(std::size_t index, double time, double std) const
{
  const Track& track = tracks_[index];
  constexpr int kMostRejections = 3;  // an identity seen this often elsewhere is elsewhere
  if (track.rejections >= kMostRejections) return true;
  const double unseen = time - std::max(track.lastSeen, track.lastHeard);
  if (!track.confirmed) return unseen > rules_.tentativeTime;
  return unseen > rules_.lostTime || !(std <= rules_.lostStd);
}
}  // namespace slamot::filters
