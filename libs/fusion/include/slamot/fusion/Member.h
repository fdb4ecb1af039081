#pragma once

#include <slamot/fusion/Sender.h>
#include <slamot/fusion/TeamOptions.h>

#include <deque>
#include <set>

namespace slamot::fusion
{
/// One good message, and what it did.
struct FusionEvent
{
  double time = 0;                ///< of the receiver [s]
  double sent = 0;                ///< the time that the message was of [s]
  Receipt receipt;                ///< what the receiver made of it
  Candidate candidate;            ///< the sighting that was taken, if any
  Gaussian<Point2D> robotBefore;  ///< the receiver's place, in map axes, before the message
  Gaussian<Point2D> robotAfter;   ///< and after it
  bool hasTarget =
      false;  ///< whether the receiver followed the target; else the next two mean nothing
  Gaussian<Point2D> targetBefore;  ///< the target's place, in map axes, before the message
  Gaussian<Point2D> targetAfter;   ///< and after it
};

/// One robot of a team: its filter, what it tells, and what it takes in.
class Member
{
 public:
  /// \param number under which the others know it; `team` are the numbers of all
  Member(int number, const std::set<int>& team, core::TeamFilter& filter,
         const TeamOptions& options, std::uint64_t session = 1);

  /// Takes in a step.  Blobs that may be team mates are taken out of it: they are for the others.
  core::Update process(core::Step& step);
  /// Whether it is time to tell.
  [[nodiscard]] bool isDue() const { return steps_ % options_.exchangeEvery == 0; }
  /// What to tell: as the filter stands after its last step.
  [[nodiscard]] Bytes tell();
  /// Keeps a message of another robot for settle(), unopened.
  void hear(Bytes bytes) { heard_.push_back(std::move(bytes)); }
  /// Takes in what was heard, in that order; what is ahead of the filter's time waits.
  std::vector<FusionEvent> settle();

  /// Under which the others know this robot.
  [[nodiscard]] int number() const { return number_; }
  /// What its filter believes now.
  [[nodiscard]] core::Estimate estimate() const { return filter_.estimate(); }
  /// What became of the messages that were settled.
  [[nodiscard]] const MessageCounts& counts() const { return receiver_.counts(); }
  /// How many messages it told.
  [[nodiscard]] std::int64_t sent() const { return sent_; }
  /// What these took in all [bytes].
  [[nodiscard]] std::int64_t bytesSent() const { return bytesSent_; }

 private:
  [[nodiscard]] bool isAhead(const Bytes& bytes) const;

  int number_;
  TeamOptions options_;
  core::TeamFilter& filter_;
  Sender sender_;
  Receiver receiver_;
  core::Step last_;  // with the team mates' blobs, without laser scans
  std::int64_t steps_ = 0, sent_ = 0, bytesSent_ = 0;
  std::deque<Bytes> heard_;
};
}  // namespace slamot::fusion
