#pragma once

#include "Settings.h"
#include "sighting/Matching.h"

#include <slamot/maps/SlotIndex.h>

#include <unordered_map>

namespace slamot::filters::rbpf
{
/// What all particles share of a scan: its sightings, and which slots of their maps each may be of.
class ScanSlots
{
 public:
  ScanSlots(const Settings& settings, int lanes);

  /// Readies a scan: rays, slots by identity or candidates from the index, a slot for each sighting
  /// that may be new.  `priors` are all particles' poses, `priorCov` their common uncertainty.
  void begin(const core::LandmarkScan* scan, double time, const std::vector<Pose2D>& priors,
             const Gaussian<Pose2D>& pending);

  /// Where a particle holds a slot's landmark after the scan; called for touched() and new slots.
  void noteExtent(int lane, std::uint32_t slot, const maps::Landmark& m)
  {
    extents_[static_cast<std::size_t>(lane)][slot].include(m.x, m.y,
                                                           largestEigenvalue(m.cxx, m.cxy, m.cyy));
  }

  /// Ends a scan: slots that no particle used are free again, the others are placed in the index.
  void finish(const std::vector<const std::vector<std::int32_t>*>& matches);

  /// After a collection: slots that no map holds are free.
  void releaseUnoccupied(const std::vector<bool>& occupied);

  [[nodiscard]] std::size_t size() const { return rays_.size(); }
  [[nodiscard]] const std::vector<Ray>& rays() const { return rays_; }
  [[nodiscard]] const core::FieldOfView& fov() const { return fov_; }
  /// Variances of the sightings, as of the last one [m², rad²].
  [[nodiscard]] double rangeVar() const { return rangeVar_; }
  [[nodiscard]] double bearingVar() const { return bearingVar_; }
  /// Slots by identity; kNew if not seen before.  Known association only.
  [[nodiscard]] const std::vector<std::int32_t>& known() const { return known_; }
  /// Slots that a sighting may be of, rising.
  [[nodiscard]] const std::vector<std::uint32_t>& near(std::size_t sighting) const
  {
    return near_[sighting];
  }
  /// Slots that might be missed; empty where misses tell nothing.
  [[nodiscard]] const std::vector<std::uint32_t>& inView() const { return inView_; }
  /// Slots near any sighting or in view, rising; their extents are noted anew.
  [[nodiscard]] const std::vector<std::uint32_t>& touched() const { return touched_; }
  [[nodiscard]] std::uint32_t newSlot(std::size_t sighting) const { return newSlots_[sighting]; }
  /// What multiplies the variances of a sighting of a slot's landmark.
  [[nodiscard]] double noise(std::uint32_t slot) const
  {
    return slot < noise_.size() ? noise_[slot] : 1.0;
  }
  /// The reported identity of a slot's landmark.
  [[nodiscard]] int idOf(std::uint32_t slot) const;

 private:
  void findKnown(const core::LandmarkScan& scan);
  void findCandidates(const std::vector<Pose2D>& priors, const Gaussian<Pose2D>& pending);
  void findInView(const core::LandmarkScan& scan, const std::vector<Pose2D>& priors);
  void setNoise();
  [[nodiscard]] maps::SlotExtent extentOf(std::uint32_t slot) const;

  const Settings& settings_;
  maps::SlotIndex index_;
  std::unordered_map<int, std::uint32_t> slotOfId_;  // known association
  std::vector<int> idOfSlot_;
  std::vector<int> pendingIds_;  // identities of the scan's sightings
  core::FieldOfView fov_;
  std::vector<Ray> rays_;
  std::vector<std::int32_t> known_;
  std::vector<std::uint32_t> newSlots_;
  std::vector<std::vector<std::uint32_t>> near_;
  std::vector<std::uint32_t> touched_, inView_;
  std::vector<std::vector<maps::SlotExtent>> extents_;  // by lane, by slot
  double time_ = 0, rangeVar_ = 0, bearingVar_ = 0;
  std::vector<double> lastSeen_, noise_;  // by slot; empty if sightings are independent
};
}  // namespace slamot::filters::rbpf
