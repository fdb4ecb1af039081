#include <slamot/live/Peers.h>

#include <utility>

namespace slamot::live
{
Peers::News Peers::hear(int sender, std::uint64_t session, double wall)
{
  if (sender == self_) return std::exchange(isDouble_, true) ? News::kNone : News::kDouble;
  if (team_.count(sender) == 0)
    return strangers_.insert(sender).second ? News::kStranger : News::kNone;
  Peer& peer = peers_[sender];
  const bool isFirst = peer.sessions == 0;
  // What is left of an earlier session does not count.
  if (!isFirst && session < peer.session) return News::kNone;
  const bool isNew = session > peer.session || isFirst;
  if (isNew) ++peer.sessions;
  peer.session = session;
  peer.heardAt = wall;
  const bool wasSilent = std::exchange(peer.isSilent, false);
  if (isNew && !isFirst) return News::kRestarted;
  return isFirst || wasSilent ? News::kCame : News::kNone;
}

std::vector<int> Peers::fallSilent(double wall)
{
  std::vector<int> out;
  for (auto& [number, peer] : peers_)
  {
    if (peer.isSilent || wall - peer.heardAt <= kSilent) continue;
    peer.isSilent = true;
    out.push_back(number);
  }
  return out;
}

std::map<int, int> Peers::sessions() const
{
  std::map<int, int> out;
  for (const auto& [number, peer] : peers_) out[number] = peer.sessions;
  return out;
}
}  // namespace slamot::live
