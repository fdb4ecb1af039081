#pragma once

#include "JointMatching.h"
#include "PoseUpdate.h"
#include "ScanSlots.h"
#include "SightingTracks.h"
#include "sighting/soften.h"
#include "sighting/unscentedSighting.h"

#include <slamot/math/random.h>

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

struct MatchScratch
{
  std::vector<Candidate> candidates;
  JointMatching::Scratch joint;
};

/// The landmark side of a scan: which landmarks its sightings are of, and what one particle does
/// with them.
class LandmarkScan
{
 public:
  LandmarkScan(const Settings& settings, maps::LandmarkPool& pool, int lanes);

  /// Readies a scan, see ScanSlots::begin().
  void begin(const core::LandmarkScan* scan, double time, const std::vector<Pose2D>& priors,
             const Gaussian<Pose2D>& pending);

  /// Gives each sighting a slot, kNew or kRejected, for one particle.
  /// \param root a square root of the pose's covariance, zero for a sampled pose.
  void match(const maps::LandmarkMap& map, const Eye& eye, const Matrix3& root,
             MatchScratch& scratch, std::vector<std::int32_t>& matches) const;

  /// The same by the sightings' tracks: what continues one keeps its landmark, the others are drawn
  /// from the likelihoods of what they may be of, one by one, each helping to place the pose for
  /// the next (sequential compatibility).  `followed` holds a particle's landmark for each track.
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

  /// What the matched sightings tell of a pose with prior N(eye, root rootᵀ).  Rejects as weigh().
  [[nodiscard]] PoseUpdate gather(const maps::LandmarkMap& map, const Eye& eye, const Matrix3& root,
                                  std::vector<std::int32_t>& matches) const;

  /// log weight of the matched sightings and of those unmatched, at a pose, or linearised at the
  /// mean of one that is not sampled yet: `update`, if given, then takes in the sightings. A
  /// sighting whose identity names a landmark far out of the outer gate becomes kRejected here.
  /// `innovations` keeps what apply() can use again if the pose stays.
  double weigh(const maps::LandmarkMap& map, const Eye& eye, const Matrix3& poseCov,
               std::vector<std::int32_t>& matches, std::vector<Innovation>& innovations,
               PoseUpdate* update) const;

  /// Takes the sightings into a particle's map, seen from its pose.
  /// \param innovations those of weigh() if the pose is still the same, else null.
  void apply(maps::LandmarkMap& map, const Eye& eye, const std::vector<std::int32_t>& matches,
             const std::vector<Innovation>* innovations, int lane);

  /// Ends a scan, see ScanSlots::finish().
  void finish(const std::vector<const std::vector<std::int32_t>*>& matches)
  {
    slots_.finish(matches);
  }
  void releaseUnoccupied(const std::vector<bool>& occupied) { slots_.releaseUnoccupied(occupied); }

  [[nodiscard]] ScanSlots& slots() { return slots_; }
  [[nodiscard]] const ScanSlots& slots() const { return slots_; }
  [[nodiscard]] std::size_t size() const { return slots_.size(); }
  [[nodiscard]] int idOf(std::uint32_t slot) const { return slots_.idOf(slot); }
  [[nodiscard]] std::uint32_t newSlot(std::size_t sighting) const
  {
    return slots_.newSlot(sighting);
  }

  /// Innovation of a sighting of a landmark.
  /// \param poseCov of a pose that is not sampled yet; else null.
  bool innovateLandmark(const Eye& eye, std::size_t j, const maps::Landmark& m,
                        const Matrix3* poseCov, Innovation& o, double noise) const
  {
    const Ray& ray = slots_.rays()[j];
    const bool unscented =
        poseCov ? settings_.proposal == Proposal::kUnscented : settings_.unscentedMap;
    if (!(unscented ? innovateUnscented(eye, ray, m.x, m.y, m.cxx, m.cxy, m.cyy, poseCov, o, noise)
                    : innovate(eye, ray, m.x, m.y, m.cxx, m.cxy, m.cyy, o, noise)))
      return false;
    soften(ray, noise, poseCov, o);
    return true;
  }

  /// The landmark that a sighting alone gives.
  [[nodiscard]] maps::Landmark bornFrom(const Eye& eye, std::size_t j) const;

 private:
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
  template <class F>
  void forPossiblePairs(const maps::LandmarkMap& map, const Eye& eye, const Matrix3& root,
                        F&& f) const;
  [[nodiscard]] bool isRatherNew(std::size_t j, const Eye& eye, const maps::Landmark& m,
                                 bool spread, const Matrix3& poseCov,
                                 const Innovation& whole) const;
  [[nodiscard]] bool mayBeOf(const maps::Landmark& m) const
  {
    return !settings_.intensity || m.confirmed;
  }
  [[nodiscard]] float hitLogOdds(const Innovation* o) const;
  void applyMisses(maps::LandmarkMap& map, const Eye& eye, const std::vector<std::int32_t>& matches,
                   int lane);

  const Settings& settings_;
  ScanSlots slots_;
  SightingTracks tracks_;
  JointMatching joint_;
  maps::LandmarkPool& pool_;
  std::vector<double> logNew_;  // log p_new for each sighting
  double logClutter_ = 0;
  double missLogOdds_ = 0, hitLogOdds_ = 0;
};
}  // namespace slamot::filters::rbpf
