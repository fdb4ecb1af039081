#pragma once

#include "Settings.h"

#include <cstdint>

namespace slamot::filters::rbpf
{
/// More than this expected is more than one target: a sure one and what a miss would leave of it
/// have less.
inline constexpr double kMostOfOneTarget = 1.5;

/// Whether two labels may stand for one target, by what is believed of each: no identity tells them
/// apart, and place and velocity are near by the younger's covariance.
[[nodiscard]] bool areOne(const core::TargetEstimate& older, const core::TargetEstimate& younger,
                          const TargetSetSettings& set);

/// The targets of targets = gm-phd as all particles share them: a label for each birth, by scan and
/// blob, so that one birth has the same label in whatever particle it took place, and keeps it
/// through resampling.  What is known of each is kept in the order of their labels, the oldest
/// first.
class TargetLabels
{
 public:
  TargetLabels(const TargetSetSettings& set, const TrackRules& rules) : set_(set), rules_(rules) {}

  static constexpr std::size_t kNone = ~std::size_t{0};

  /// Of each label: `confirmed` while it is to be reported, `id` once it was.
  [[nodiscard]] const std::vector<Track>& list() const { return tracks_; }
  [[nodiscard]] std::uint64_t key(std::size_t index) const { return keys_[index]; }
  /// A label's place in the list; kNone if it is not there.
  [[nodiscard]] std::size_t find(std::uint64_t key) const;

  /// A target whose start is known, with its identity.
  void addStart(int id, double time);
  /// The labels that a scan's blobs bear: new ones, of which the order of the blobs does not
  /// matter, but that of an identity's target where it is known.
  [[nodiscard]] std::vector<std::uint64_t> birthKeys(const std::vector<core::Blob>& blobs,
                                                     std::uint64_t scan) const;
  /// A label that a blob bore; nothing if it is in the list.
  void add(std::uint64_t key, const core::Blob& blob, double time);
  /// A blob was, on the whole, of a target.
  void hit(std::size_t index, const core::Blob& blob, double time);
  /// A target's existence, the number expected under its label, decides whether it is confirmed,
  /// with hysteresis.  Targets without identity are numbered in that order.
  void settle(std::size_t index, double existence);
  /// Whether a label is lost: not seen for long, or its place too uncertain [m].
  [[nodiscard]] bool isLost(std::size_t index, double time, double std) const;
  void erase(std::size_t index);

 private:
  TargetSetSettings set_;
  TrackRules rules_;
  std::vector<std::uint64_t> keys_;  // rising
  std::vector<Track> tracks_;        // of each key
  std::vector<int> usedIds_;         // identities seen, so that numbers keep clear of them
  int nextNumber_ = 0;
};
}  // namespace slamot::filters::rbpf
