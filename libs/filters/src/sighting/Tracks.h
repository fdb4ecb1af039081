#pragma once

#include <slamot/core/Params.h>
#include <slamot/core/Step.h>

#include <string>
#include <vector>

namespace slamot::filters
{
/// When targets start, are believed, and are lost.
struct TrackRules
{
  int confirmSightings;  ///< sightings until a target without identity is believed
  double tentativeTime;  ///< [s] without a sighting after which one not yet believed is dropped
  double lostTime;       ///< [s] without a sighting after which a target is lost
  double lostStd;        ///< [m] deviation of its place beyond which a target is lost
  static TrackRules from(core::Params& p);
};

/// One followed target, as all particles share it; its state is each particle's own.
struct Track
{
  int id = core::kNoId;  ///< identity, or number by order of confirmation; none while tentative
  std::string label;     ///< empty: not known yet (a start)
  bool identified = false, confirmed = false;
  int hits = 0;
  int rejections = 0;  ///< sightings with its identity in a row that were out of every gate
  double lastSeen = 0;
  double lastHeard = -1e300;  ///< when another robot last told of it
};

/// The targets that are followed: the bookkeeping that does not depend on a particle.
class Tracks
{
 public:
  explicit Tracks(const TrackRules& rules) : rules_(rules) {}

  [[nodiscard]] const std::vector<Track>& list() const { return tracks_; }
  /// Whether a blob may be of a track: same label, and same identity where both have one.
  [[nodiscard]] static bool fits(const Track& track, const core::Blob& blob);

  void addStart(int id, double time);
  /// A new last track from a blob.
  void add(const core::Blob& blob, double time);
  /// A sighting of a track.
  void hit(std::size_t index, const core::Blob& blob, double time);
  /// Another robot told of a track.
  void hear(std::size_t index, double time) { tracks_[index].lastHeard = time; }
  /// A blob out of every gate: counts against the track of its identity.
  void reject(const core::Blob& blob);
  /// Whether a track whose place has this deviation [m] is lost by now.
  [[nodiscard]] bool isLost(std::size_t index, double time, double std) const;
  void erase(std::size_t index)
  {
    tracks_.erase(tracks_.begin() + static_cast<std::ptrdiff_t>(index));
  }

 private:
  void confirm(Track& track);

  TrackRules rules_;
  std::vector<Track> tracks_;
  std::vector<int> usedIds_;  // identities seen, so that numbers keep clear of them
  int nextNumber_ = 0;
};
}  // namespace slamot::filters
