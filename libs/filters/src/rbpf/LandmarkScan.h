#pragma once

#include "PoseUpdate.h"
#include "Settings.h"
#include "SightingTracks.h"

#include <slamot/maps/SlotIndex.h>
#include <slamot/math/random.h>

#include <unordered_map>

namespace slamot::filters::rbpf
{
/// What a sighting may be of, with the logarithm of its likelihood.
struct Choice
{
  std::int32_t what;  ///< a slot or kNew
  double logLikelihood;
  Innovation innovation;  ///< from the prior pose; not set for kNew
};

struct TrackScratch
{
  std::vector<std::size_t> open;  // sightings whose tracks have no landmark yet
  std::vector<Choice> choices, chosen;
  std::vector<Candidate> candidates;
  std::vector<Innovation> innovations;
};

/// The landmark side of a scan: which slots its sightings may be of, for all particles at once, and
/// what one particle does with them.
class LandmarkScan
{
 public:
  LandmarkScan(const Settings& settings, maps::LandmarkPool& pool, int lanes);

  /// Readies a scan: rays, slots by identity or candidates from the index, a slot for each sighting
  /// that may be new.  `priors` are all particles' poses, `priorCov` their common uncertainty.
  void begin(const core::LandmarkScan* scan, double time, const std::vector<Pose2D>& priors,
             const Gaussian<Pose2D>& pending);

  /// Gives each sighting a slot, kNew or kRejected, for one particle.
  void match(const maps::LandmarkMap& map, const Eye& eye, const Matrix3& poseCov,
             std::vector<Candidate>& candidates, std::vector<std::int32_t>& matches);

  /// The same by the sightings' tracks: what continues one keeps its landmark, the others are drawn
  /// from the likelihoods of what they may be of, one by one, each helping to place the pose for
  /// the next (sequential compatibility).  `followed` holds a particle's landmark for each track.
  /// `root` is a square root of the pose's covariance, zero for a sampled pose.
  /// \return what the drawing adds to the log weight: log of the sum over the chosen likelihood.
  double matchTracks(const maps::LandmarkMap& map, const Eye& eye, const Matrix3& root,
                     std::vector<std::int32_t>& followed, math::RandomStream& random,
                     TrackScratch& scratch, std::vector<std::int32_t>& matches) const;
  /// The robot has moved.
  void move(const Gaussian<Pose2D>& increment)
  {
    if (tracks_.isOn()) tracks_.move(increment);
  }
  /// Whether matchTracks() is to be used in place of match().
  [[nodiscard]] bool hasTracks() const { return tracks_.isOn(); }

  /// log weight of the matched sightings and of those unmatched; fills `update` where it is
  /// informed. A sighting whose identity names a landmark far out of the outer gate becomes
  /// kRejected here. `innovations` keeps what apply() can use again if the pose stays.
  double weigh(const maps::LandmarkMap& map, const Eye& eye, const Matrix3& poseCov,
               std::vector<std::int32_t>& matches, std::vector<Innovation>& innovations,
               PoseUpdate* update) const;

  /// Takes the sightings into a particle's map, seen from its pose.
  /// \param innovations those of weigh() if the pose is still the same, else null.
  void apply(maps::LandmarkMap& map, const Eye& eye, const std::vector<std::int32_t>& matches,
             const std::vector<Innovation>* innovations, int lane);

  /// Ends a scan: slots that no particle used are free again, the others are placed in the index.
  void finish(const std::vector<const std::vector<std::int32_t>*>& matches);

  /// After a collection: slots that no map holds are free.
  void releaseUnoccupied(const std::vector<bool>& occupied);

  [[nodiscard]] std::size_t size() const { return rays_.size(); }
  /// The reported identity of a slot's landmark.
  [[nodiscard]] int idOf(std::uint32_t slot) const;
  [[nodiscard]] std::uint32_t newSlot(std::size_t sighting) const { return newSlots_[sighting]; }

 private:
  void findKnown(const core::LandmarkScan& scan);
  void findCandidates(const std::vector<Pose2D>& priors, const Gaussian<Pose2D>& pending);
  void findInView(const core::LandmarkScan& scan, const std::vector<Pose2D>& priors);
  void noteExtent(int lane, std::uint32_t slot, const maps::Landmark& m);
  /// Innovation of sighting j of a landmark, whose slot tells how much of its noise is new.
  bool innovateLandmark(const Eye& eye, std::size_t j, std::uint32_t slot, const maps::Landmark& m,
                        Innovation& o) const
  {
    return innovate(eye, rays_[j], m.x, m.y, m.cxx, m.cxy, m.cyy, o,
                    slot < noise_.size() ? noise_[slot] : 1.0);
  }
  /// Matches what continues a track; `scratch.open` becomes the sightings still to be decided.
  PoseUpdate continueTracks(const maps::LandmarkMap& map, const Eye& eye, const Matrix3& root,
                            std::vector<std::int32_t>& followed, TrackScratch& scratch,
                            std::vector<std::int32_t>& matches) const;
  /// The open sighting that leaves least doubt, so that it helps to tell the others; its choices
  /// are then in `scratch.chosen`.
  std::vector<std::size_t>::iterator clearest(const maps::LandmarkMap& map, const Eye& eye,
                                              const PoseUpdate::Result& pose,
                                              const std::vector<std::int32_t>& matches,
                                              TrackScratch& scratch) const;
  void listChoices(const maps::LandmarkMap& map, const Eye& eye, const PoseUpdate::Result& pose,
                   std::size_t j, const std::vector<std::int32_t>& matches,
                   std::vector<Choice>& choices) const;
  void setNoise();
  void applyMisses(maps::LandmarkMap& map, const Eye& eye, const std::vector<std::int32_t>& matches,
                   int lane);

  const Settings& settings_;
  SightingTracks tracks_;
  maps::LandmarkPool& pool_;
  maps::SlotIndex index_;
  std::unordered_map<int, std::uint32_t> slotOfId_;  // known association
  std::vector<int> idOfSlot_;
  std::vector<int> pendingIds_;  // identities of the scan's sightings
  core::FieldOfView fov_;
  std::vector<Ray> rays_;
  std::vector<double> logNew_;            // log p_new for each sighting
  std::vector<std::int32_t> knownSlots_;  // by identity; kNew if not seen before
  std::vector<std::uint32_t> newSlots_;
  std::vector<std::vector<std::uint32_t>> near_;        // slots that each sighting may be of
  std::vector<std::uint32_t> touched_;                  // slots whose extent this scan sets anew
  std::vector<std::uint32_t> inView_;                   // slots that might be missed
  std::vector<std::vector<maps::SlotExtent>> extents_;  // by lane, by slot
  double time_ = 0;
  std::vector<double> lastSeen_, noise_;  // by slot; empty if sightings are independent
  double missLogOdds_ = 0, hitLogOdds_ = 0;
};
}  // namespace slamot::filters::rbpf
