#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace slamot::fusion
{
/// What became of a message: one of these each.  But for the first, its receiver's estimate is
/// unchanged, to the bit.
enum class Outcome
{
  kFused,
  kDidNotPay,  ///< good, but no weight makes the estimate better
  kFusionOff,  ///< good, but the rule is `none`
  // The bytes.
  kWrongVersion,   ///< other first bytes, or another version
  kWrongLength,    ///< too short, too long, or not what its counts say
  kWrongChecksum,  ///< damaged on the way
  kContradictory,  ///< a target without coordinates, or coordinates without a target
  // The address.
  kFromItself,
  kUnknownSender,
  kToAnother,
  kOtherFrame,  ///< coordinates in another map's frame
  // The order.
  kNotNewer,  ///< repeated or overtaken: not after the last good one of its sender
  kTooOld,
  kFromTheFuture,
  // The values.
  kNotFinite,
  kAbsurd,  ///< a variance, place or range of impossible size
  kNotPositiveDefinite,
  // The fit.
  kNoSuchTarget,         ///< its target isn't followed here, and it had no sighting of this robot
  kNothingUsable,        ///< neither a target nor a sighting of now
  kTargetGateFailed,     ///< its target is not where this robot's is
  kCandidateGateFailed,  ///< no target, and none of its sightings is this robot
  kRefusedByFilter,
  kCount
};

/// Things that happen beside the outcome.
enum class Note
{
  kAmbiguous,          ///< several sightings could be this robot; the likeliest was taken
  kLateCandidates,     ///< sightings too old for a robot that moves; left out
  kCandidatesOutside,  ///< it had sightings, but none that could be this robot
  kCouldBeAnother,     ///< a sighting that could be yet another robot; left out
  kCandidateFused,     ///< a sighting of this robot was fused
  kTargetFused,
  kCount
};

/// The name under which reports count it, such as `wrong_checksum`.
[[nodiscard]] const char* name(Outcome outcome);
[[nodiscard]] const char* name(Note note);

/// How many messages became what.
class MessageCounts
{
 public:
  void add(Outcome outcome) { ++outcomes_[static_cast<std::size_t>(outcome)]; }
  void add(Note note) { ++notes_[static_cast<std::size_t>(note)]; }

  [[nodiscard]] std::int64_t of(Outcome o) const { return outcomes_[static_cast<std::size_t>(o)]; }
  [[nodiscard]] std::int64_t of(Note n) const { return notes_[static_cast<std::size_t>(n)]; }
  /// All messages: the sum over outcomes.
  [[nodiscard]] std::int64_t messages() const;
  /// Every outcome, then every note, by name, zeros too: always the same rows.
  [[nodiscard]] std::vector<std::pair<std::string, std::int64_t>> rows() const;

 private:
  std::array<std::int64_t, static_cast<std::size_t>(Outcome::kCount)> outcomes_{};
  std::array<std::int64_t, static_cast<std::size_t>(Note::kCount)> notes_{};
};
}  // namespace slamot::fusion
