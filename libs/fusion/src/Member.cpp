#include <slamot/fusion/Member.h>

#include <slamot/fusion/mates.h>

namespace slamot::fusion
{
namespace
{
Sender::Options senderOptions(const TeamOptions& o, std::uint64_t session)
{
  Sender::Options out;
  out.frame = o.frame;
  out.target = o.target;
  out.mateLabel = o.mateLabel;
  out.tellIdentities = o.mateIdentities;
  out.session = session;
  return out;
}

Receiver::Options receiverOptions(const TeamOptions& o, int number, const std::set<int>& team)
{
  Receiver::Options out;
  out.frame = o.frame;
  out.senders = team;
  out.senders.erase(number);
  out.identity = number;
  out.believeIdentities = o.mateIdentities;
  out.mateSpeed = o.mateSpeed;
  out.candidateGate = o.candidateGate;
  out.targetGate = o.targetGate;
  out.maxAge = o.maxAge;
  out.candidateMaxAge = o.candidateMaxAge;
  out.fusion = o.fusion;
  return out;
}

Gaussian<Point2D> placeAt(const core::RobotAndTarget& of, int begin)
{
  return {{of.mean[begin], of.mean[begin + 1]}, of.cov.block<2, 2>(begin, begin)};
}
}  // namespace

Member::Member(int number, const std::set<int>& team, core::TeamFilter& filter,
               const TeamOptions& options, std::uint64_t session)
    : number_(number),
      options_(options),
      filter_(filter),
      sender_(number, senderOptions(options, session)),
      receiver_(number, receiverOptions(options, number, team))
{
}

core::Update Member::process(core::Step& step)
{
  last_ = step;
  last_.lasers.clear();
  takeOutMates(step, options_.mateLabel);
  core::Update out = filter_.process(step);
  ++steps_;
  return out;
}

Bytes Member::tell()
{
  Bytes out = encode(sender_.make(filter_, last_));
  ++sent_;
  bytesSent_ += static_cast<std::int64_t>(out.size());
  return out;
}

bool Member::isAhead(const Bytes& bytes) const
{
  const auto decoded = decode(bytes);
  const auto* const message = std::get_if<Message>(&decoded);
  if (!message) return false;
  const double ahead = message->estimate.time - last_.time;
  return ahead > Receiver::Options{}.futureTolerance && ahead <= options_.maxAge;
}

std::vector<FusionEvent> Member::settle()
{
  std::vector<FusionEvent> out;
  std::deque<Bytes> waiting;
  for (Bytes& bytes : heard_)
  {
    if (isAhead(bytes))
    {
      waiting.push_back(std::move(bytes));
      continue;
    }
    const core::RobotAndTarget before = filter_.robotAndTarget(options_.target);
    FusionEvent event;
    event.time = last_.time;
    event.receipt = receiver_.receive(bytes, last_.time, filter_);
    if (event.receipt.outcome != Outcome::kFused && event.receipt.outcome != Outcome::kDidNotPay)
      continue;
    const Message message = std::get<Message>(decode(bytes));
    event.sent = message.estimate.time;
    if (event.receipt.candidate >= 0)
      event.candidate = message.candidates[static_cast<std::size_t>(event.receipt.candidate)];
    const core::RobotAndTarget after = filter_.robotAndTarget(options_.target);
    event.robotBefore = placeAt(before, 0);
    event.robotAfter = placeAt(after, 0);
    event.hasTarget = before.targetSize() > 0;
    if (event.hasTarget) event.targetBefore = placeAt(before, core::RobotAndTarget::kRobot);
    if (event.hasTarget) event.targetAfter = placeAt(after, core::RobotAndTarget::kRobot);
    out.push_back(event);
  }
  heard_ = std::move(waiting);
  return out;
}
}  // namespace slamot::fusion
