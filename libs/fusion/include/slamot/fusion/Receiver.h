#pragma once

#include <slamot/fusion/checkMessage.h>

#include <map>
#include <set>

namespace slamot::fusion
{
/// What became of one message, and how.
struct Receipt
{
  Outcome outcome = Outcome::kNothingUsable;  ///< what became of it in the end
  int sender = core::kNoId;                   ///< as the message says, once its checksum held
  int candidate = -1;        ///< place in the message of the sighting taken; -1: none
  int candidatesPassed = 0;  ///< more than one: ambiguous
  bool targetFused = false;  ///< the target's coordinates were in what was fused
  double omega = 1;          ///< weight of one's own estimate
};

/// Takes in messages for one robot: decodes, checks, gates and fuses them.  A message does nothing
/// to the filter but by one call of TeamFilter::fuse(), at the very end.
///
/// The target must pass its gate, or nothing of the message is believed.  A candidate must pass
/// its own gate and, where the target is fused too, the gate of both together: a place that is
/// near this robot, but off by other than the target is, although the same errors moved both, is
/// most likely false.  Candidates that fail are left out, the target is fused all the same.  Of
/// several that pass the likeliest is taken, and counted as ambiguous.  A candidate without
/// identity that could as well be another robot of the team, by what that one last told of itself,
/// is left out: among robots that look alike, the nearest is often not this one.
class Receiver
{
 public:
  /// What this robot believes of others.
  struct Options
  {
    std::string frame = "map";      ///< the map frame that all robots share
    std::set<int> senders;          ///< robots that are heard
    int identity = core::kNoId;     ///< under which sensors know this robot; sightings of another
                                    ///< identity are left out
    bool believeIdentities = true;  ///< false: sightings count as without identity
    double mateSpeed = 3;         ///< [m/s]: by which other robots may be off where they last were
    double candidateGate = 0.99;  ///< chance that a true sighting of this robot is kept
    double targetGate = 0.999;    ///< chance that a true target is kept
    double maxAge = 1;            ///< [s]: older messages are dropped
    double candidateMaxAge = 0.02;  ///< [s]: older sightings of a robot that moves are left out
    double futureTolerance = 0.02;  ///< [s]: of clocks; a message so little ahead is of now
    MessageLimits limits;           ///< of values that can be true
    core::FusionOptions fusion;     ///< how what passes is fused
  };

  /// \throws core::Error (kConfig) if an option is out of range.
  Receiver(int self, Options options);

  /// Takes in one message.  `now` is the time that the filter's estimate is for [s]; a message
  /// ahead of it is dropped, so keep it until the step that reaches it.
  Receipt receive(const Bytes& bytes, double now, core::TeamFilter& filter);

  /// Of all messages received so far.
  [[nodiscard]] const MessageCounts& counts() const { return counts_; }

 private:
  [[nodiscard]] std::optional<Outcome> checkEnvelope(const Message& m, double now) const;
  void fuse(const Message& m, double now, core::TeamFilter& filter, Receipt& receipt);
  /// Whether a place could be that of a robot other than this one and `sender`.
  [[nodiscard]] bool couldBeAnother(const core::Evidence& place, const core::RobotAndTarget& own,
                                    int sender, double now) const;
  // Replaces the evidence of the target alone by that of both, if a candidate fits.
  void chooseCandidate(const Message& m, double now, const core::RobotAndTarget& told,
                       const core::RobotAndTarget& own, int shared,
                       std::optional<core::Evidence>& evidence, Receipt& receipt);
  void deliver(const core::Evidence& evidence, int shared, core::TeamFilter& filter,
               Receipt& receipt);

  int self_;
  Options options_;
  std::map<int, std::pair<std::uint64_t, std::uint64_t>> last_;  // session, sequence by sender
  struct Mate
  {
    double time;  // [s]
    Gaussian<Point2D> place;
  };
  std::map<int, Mate> mates_;  // by what each last told of itself
  MessageCounts counts_;
};
}  // namespace slamot::fusion
