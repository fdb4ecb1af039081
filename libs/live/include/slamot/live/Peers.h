#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <vector>

namespace slamot::live
{
/// Who of the team is there, by what they send.
class Peers
{
 public:
  /// What a packet tells of its sender.
  enum class News
  {
    kNone,       ///< it is known to be there
    kCame,       ///< heard for the first time, or again after a silence
    kRestarted,  ///< heard with a new session
    kDouble,     ///< another robot has this one's number
    kStranger    ///< not of this team; once for each
  };
  static constexpr double kSilent = 3;  ///< [s] without a word

  /// \param team numbers of all, this robot's too.
  Peers(int self, std::set<int> team) : self_(self), team_(std::move(team)) {}

  /// Takes in that a packet of this robot and session came at a wall time [s].
  News hear(int sender, std::uint64_t session, double wall);
  /// Whether it is the number of another robot of the team.
  [[nodiscard]] bool isOfTeam(int sender) const
  {
    return sender != self_ && team_.count(sender) > 0;
  }
  /// Those who fell silent since the last call.
  [[nodiscard]] std::vector<int> fallSilent(double wall);
  /// Whether all others have been heard.
  [[nodiscard]] bool areAllHeard() const { return sessions().size() + 1 == team_.size(); }
  /// How many sessions, that is starts, of each other robot were heard.
  [[nodiscard]] std::map<int, int> sessions() const;

 private:
  struct Peer
  {
    std::uint64_t session = 0;
    int sessions = 0;
    double heardAt = 0;
    bool isSilent = false;
  };
  int self_;
  std::set<int> team_, strangers_;
  bool isDouble_ = false;
  std::map<int, Peer> peers_;
};
}  // namespace slamot::live
