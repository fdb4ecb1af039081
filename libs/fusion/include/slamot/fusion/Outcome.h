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
  kFused,      ///< taken in; the estimate is better
  kDidNotPay,  ///< good, but no weight makes the estimate better
  kFusionOff,  ///< good, but the rule is `none`
  // The bytes.
  kWrongVersion,   ///< other first bytes, or another version
  kWrongLength,    ///< too short, too long, or not what its counts say
  kWrongChecksum,  ///< damaged on the way
  kContradictory,  ///< a target without coordinates, or coordinates without a target
  // The address.
  kFromItself,     ///< the receiver's own, come back
  kUnknownSender,  ///< of a robot that is none of the team
  kToAnother,      ///< for another robot
  kOtherFrame,     ///< coordinates in another map's frame
  // The order.
  kNotNewer,       ///< repeated or overtaken: not after the last good one of its sender
  kTooOld,         ///< older than Receiver::Options::maxAge
  kFromTheFuture,  ///< ahead by more than Receiver::Options::futureTolerance
  // The values.
  kNotFinite,            ///< a number is none, or infinite
  kAbsurd,               ///< a variance, place or range of impossible size
  kNotPositiveDefinite,  ///< a covariance that is none
  // The fit.
  kNoSuchTarget,         ///< its target isn't followed here, and it had no sighting of this robot
  kNothingUsable,        ///< neither a target nor a sighting of now
  kTargetGateFailed,     ///< its target is not where this robot's is
  kCandidateGateFailed,  ///< no target, and none of its sightings is this robot
  kRefusedByFilter,      ///< TeamFilter::fuse() threw
  kCount                 ///< how many there are
};

/// Things that happen beside the outcome.
enum class Note
{
  kAmbiguous,          ///< several sightings could be this robot; the likeliest was taken
  kLateCandidates,     ///< sightings too old for a robot that moves; left out
  kCandidatesOutside,  ///< it had sightings, but none that could be this robot
  kCouldBeAnother,     ///< a sighting that could be yet another robot; left out
  kCandidateFused,     ///< a sighting of this robot was fused
  kTargetFused,        ///< its target was fused
  kCount               ///< how many there are
};

/// The name under which reports count it, such as `wrong_checksum`.
[[nodiscard]] const char* name(Outcome outcome);
/// As of an outcome, such as `could_be_another`.
[[nodiscard]] const char* name(Note note);

/// How many messages became what.
class MessageCounts
{
 public:
  /// One more message with this outcome.
  void add(Outcome outcome) { ++outcomes_[static_cast<std::size_t>(outcome)]; }
  /// One more of these.
  void add(Note note) { ++notes_[static_cast<std::size_t>(note)]; }

  /// How many messages had this outcome.
  [[nodiscard]] std::int64_t of(Outcome o) const { return outcomes_[static_cast<std::size_t>(o)]; }
  /// How often that was noted.
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
