#include <slamot/core/Error.h>
#include <slamot/fusion/Sender.h>

#include <algorithm>

namespace slamot::fusion
{
Sender::Sender(int self, Options options) : self_(self), options_(std::move(options))
{
  const auto fail = [](const char* what)
  { throw core::Error(core::ExitStatus::kConfig, "team", what); };
  if (self < 0) fail("a robot's number is negative");
  if (options_.maxCandidates < 0 || options_.maxCandidates > kMaxCandidates)
    fail("a message has 0 to 16 candidates");
  if (options_.frame.empty() || options_.frame.size() > kMaxFrameLength)
    fail("the frame's name has 1 to 32 characters");
}

Message Sender::make(const core::TeamFilter& filter, const core::Step& step, int receiver)
{
  Message m;
  m.sender = self_;
  m.receiver = receiver;
  m.session = options_.session;
  m.sequence = ++sequence_;
  m.frame = options_.frame;
  m.estimate = filter.robotAndTarget(options_.target);
  if (m.estimate.targetSize() == 0) m.estimate.target = core::kNoId;
  // A target of known speed has a singular covariance, which is no message: a little more doubt.
  constexpr double kDoubt = 1e-6;  // variance [m²/s²]
  for (int i = core::RobotAndTarget::kRobot + 2; i < m.estimate.mean.size(); ++i)
    m.estimate.cov(i, i) += kDoubt;
  if (!step.blobs || step.time != m.estimate.time) return m;
  for (const core::Blob& b : step.blobs->blobs)
  {
    if (static_cast<int>(m.candidates.size()) == options_.maxCandidates) break;
    if (b.label != options_.mateLabel || !b.range) continue;
    m.candidates.push_back({*b.range, b.bearing, b.rangeStd, b.bearingStd,
                            options_.tellIdentities ? b.id : core::kNoId});
  }
  return m;
}
}  // namespace slamot::fusion
